(()=>{var{find:J,make:w}=document.currentScript.shared;var{CanvasPen:K}=document.currentScript.shared;var{HALO_WIDTH:Z,SERIF:A,STYLES:Q,colours:L}=document.currentScript.shared;var{writeNumber:M}=document.currentScript.shared;var{LIGHT:X,Pen:ee,cornersOf:te,textParts:ne,traceDisc:se}=document.currentScript.shared;var{counted:x}=document.currentScript.shared;var{along:ae}=document.currentScript.shared;var{tableLonlat:oe}=document.currentScript.shared;var{lonLatOf:R}=document.currentScript.shared;var{asCount:z}=document.currentScript.shared;var{Kept:F,filled:H,run:ie}=document.currentScript.shared;var{poleSeen:re}=document.currentScript.shared;var Te=3,Ie=3,je=class extends ee{#e=[];#t=[];text(e){let[t,n]=[m(this.width),m(this.height)];return`${[`<svg xmlns="http://www.w3.org/2000/svg" width="${t}" height="${n}" viewBox="0 0 ${t} ${n}">`,`<title>${W(e)}</title>`,...this.#e.length>0?[`<defs>${this.#e.join("")}</defs>`]:[],`<rect width="${t}" height="${n}" ${v("fill",this.colours.paper)}/>`,`<g fill="none" stroke-linecap="round" stroke-linejoin="round" font-family='${A}'>`,...this.#t].join(`
`)}
</g>
</svg>
`}path(e,t,n,s){let a=le(t);if(a==="")return;let i=[];s.fill!==void 0&&i.push(v("fill",n??this.colours[s.fill],s.fillOpacity)),s.stroke!==void 0&&i.push(this.#n(s,n)),this.#t.push(`<path class="${e}" ${i.join(" ")} d="${a}"/>`)}within({opacity:e=1,region:t,corner:n},s){let a=`clip-${this.#e.length}`;t&&this.#e.push(`<clipPath id="${a}"><path d="${le(t)}"/></clipPath>`);let i=t?` clip-path="url(#${a})"`:"",r=e<1?` opacity="${e}"`:"",c=n?` transform="translate(${n.map(m).join(" ")})"`:"";this.#t.push(`<g${i}${r}${c}>`),s(),this.#t.push("</g>")}discs(e,t,n){let{radius:s,fill:a,rim:i,rimWidth:r,opacity:c}=t,o=m(s-r/2),l=`dots-${this.#e.length}`,d=[];for(let h=0;h<n.length;h+=2)d.push(`<circle cx="${m(n[h])}" cy="${m(n[h+1])}" r="${o}"/>`);this.#e.push(`<g id="${l}">${d.join("")}</g>`);let p=`fill="none" ${v("stroke",this.colours[i],c)} stroke-width="${m(2*r)}"`;this.#t.push(`<use class="${e}-rim" href="#${l}" ${p}/>`),this.#t.push(`<use class="${e}" href="#${l}" ${v("fill",this.colours[a],c)}/>`)}spots(e,t){let n=this.#n(Q["spot-line"]);t.forEach((s,a)=>{let[i,r,c]=[e[3*a],e[3*a+1],e[3*a+2]].map(m);this.#t.push(`<circle class="spot" cx="${i}" cy="${r}" r="${c}" ${v("fill",s)} ${n}/>`)})}label(e,t,n,s){let a={left:"start",center:"middle",right:"end"}[s.align??"left"],i=ne(e,s.italic??!1).map(o=>o.italic?`<tspan font-style="italic">${W(o.text)}</tspan>`:W(o.text)).join(""),r=`paint-order="stroke" ${v("stroke",this.inkOf(s.halo))} stroke-width="${Z}"`,c=`x="${m(t)}" y="${m(n)}" font-size="${s.size}" text-anchor="${a}"`;this.#t.push(`<text ${c} ${v("fill",this.inkOf(s.ink))} ${r}>${i}</text>`)}picture(e,t,n,s,a){if(e instanceof HTMLImageElement){let c=decodeURIComponent(e.src.slice(e.src.indexOf(",")+1));return this.within({corner:[t,n]},()=>this.#t.push(c))}let i=document.createElement("canvas");[i.width,i.height]=[e.width,e.height],i.getContext("2d").drawImage(e,0,0);let r=`x="${m(t)}" y="${m(n)}" width="${m(s)}" height="${m(a)}"`;this.#t.push(`<image ${r} preserveAspectRatio="none" href="${i.toDataURL("image/png")}"/>`)}#n(e,t=this.colours[e.stroke??"ink"]){let n=e.dash===void 0?"":` stroke-dasharray="${e.dash.join(" ")}"`;return`${v("stroke",t,e.strokeOpacity)} stroke-width="${m(e.width??1)}"${n}`}fillDisc({x:e,y:t,r:n},s){let a=typeof s=="string"?v("fill",s):`fill="url(#${s.id})"`;if(this.#t.push(`<circle ${a} cx="${m(e)}" cy="${m(t)}" r="${m(n)}"/>`),typeof s=="string")return;let i=s.stops.map(([o,l])=>`<stop offset="${o}" ${v("stop-color",l,1,"stop-opacity")}/>`),r=Object.entries(X).map(([o,l])=>`${o}="${m((l+(o==="r"?0:1))/2)}"`),c=`<radialGradient id="${s.id}" ${r.join(" ")}>${i.join("")}</radialGradient>`;this.#e.includes(c)||this.#e.push(c)}};function le(e){let t="";return e({moveTo:(n,s)=>t+=`M${m(n)} ${m(s)}`,lineTo:(n,s)=>t+=`L${m(n)} ${m(s)}`,ellipse(n,s,a,i,r,c,o,l=!1){let[d,p]=[Math.cos(r),Math.sin(r)],h=u=>{let[b,y]=[a*Math.cos(u),i*Math.sin(u)];return[n+b*d-y*p,s+b*p+y*d]};t===""?this.moveTo(...h(c)):this.lineTo(...h(c));let g=Math.ceil(Math.abs(o-c)/Ie),f=`${m(a)} ${m(i)} ${m(r*180/Math.PI)} 0 ${l?0:1}`;for(let u=1;u<=g;++u){let[b,y]=h(c+(o-c)*u/g);t+=`A${f} ${m(b)} ${m(y)}`}},closePath:()=>t+="Z"}),t}function m(e){return M(e,Te)}function v(e,t,n=1,s=`${e}-opacity`){let[a,i,r,c=1]=(t.match(/[\d.]+/g)??[]).map(Number),o=c*n,l=o===1?"":` ${s}="${m(o)}"`;return`${e}="rgb(${a}, ${i}, ${r})"${l}`}function W(e){return e.replace(/&/g,"&amp;").replace(/</g,"&lt;").replace(/>/g,"&gt;")}var S={lon:["longitude","lon","lng","long","longitud","longitudine","längengrad","laengengrad","долгота","经度","經度","経度","خط الطول"],lat:["latitude","lat","latitud","latitudine","breitengrad","широта","纬度","緯度","خط العرض"],unsure_lon:["x","xcoord","länge","laenge","الطول"],unsure_lat:["y","ycoord","breite","العرض"],beside:["coord","coords","coordinate","coordinates","point","geo","geogr","geographische","deg","degrees","grad"],missing:["","na","n/a","#n/a","nan","null","none","<na>","-","–"],compass:{E:"East Ost Osten Est Este Leste в.д. 东经 東経 شرقا",W:"West Westen Ouest Oeste Ovest з.д. 西经 西経 غربا",N:"North Nord Norden Norte с.ш. 北纬 北緯 شمالا",S:"South Süd Süden Sud Sur Sul ю.ш. 南纬 南緯 جنوبا"},lettered:"n\\W?s|e\\W?w|[nsew]|\\w*hem\\w*|\\w*(?:lat|lon)\\w*(?:ns|ew|[nsew]|dir|ref)|column_\\d+",zeros:"٠۰０",printed:"−–   　٫．，،",typed:"--    ..,,",unseen:"​‎‏\uFEFF",western:"°ºªà-öø-ÿÀ-ÖØ-ß€‘’“”–—«»²³µ ŒœŠšŽžŸ"},P=/^[-+]?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:e[-+]?[0-9]+)?$/i,Ce=new Set(S.missing),E=e=>Ce.has(e.trim().toLowerCase()),Fe=new RegExp(`\\0|[^\\x00-\\x7f${S.western}]|[^\\x00-\\x7f]{3}`),He="぀";function U(e,t=!1){let[n,s]=["lon","lat"].map(a=>{let[i,r]=[S[a],S[`unsure_${a}`]],l=[d=>i.includes(d),(d,p)=>i.some(h=>p.includes(h)||h>He&&d.includes(h)),(d,p)=>p.length>0&&p.every(h=>r.includes(h))].slice(0,t?2:3).map(d=>e.filter(p=>d(p.trim().toLowerCase(),We(p)))).find(d=>d.length>0);return l?.length===1?l[0]:null});return n===null||s===null||n===s?null:[n,s]}function We(e){return e.replace(/(?<=[a-z])(?=[A-Z])/g," ").toLowerCase().split(/[^\p{L}]+/u).filter(n=>n!==""&&!S.beside.includes(n))}var Ue=new RegExp(`^(?:${S.lettered})$`,"iu"),Ge=new RegExp(`[${S.printed}${S.unseen}]`,"gu");function T(e){return e.replace(Ge,n=>S.typed[S.printed.indexOf(n)]??"").trim().replace(/\s+/g," ")}var Ve=new Map(Object.entries({...S.compass,O:"O"}).flatMap(([e,t])=>[e,...t.toLowerCase().split(" ")].map(n=>[n,e]))),me=e=>Ve.get(e.length>1?e.toLowerCase():e),ce="[0-9]+(?:[.,][0-9]*)?",Be=new RegExp(`^(?<before>[\\p{L}.]+)?\\s*(?<sign>[-+])?\\s*(?<degrees>[0-9]{1,3}(?:[.,][0-9]*)?)(?:\\s*(?:deg(?:rees?)?|[°º˚d:度]|\\s)\\s*(?:(?<minutes>${ce})(?:\\s*(?:min|['′’‘´m:分]|\\s)\\s*(?:(?<seconds>${ce})\\s*(?:''|’’|′′|["″”“秒]|sec|s)?)?)?)?)?\\s*(?<after>[\\p{L}.]+)?$`,"u");function qe(e){let t=e.length>200?null:Be.exec(T(e))?.groups;if(!t)return null;let{before:n,after:s,sign:a}=t,i=[t.degrees,t.minutes,t.seconds].filter(p=>p!==void 0),r=i.map(p=>p.replace(",",".").replace(/\.$/,"")),c=n??s?me(n??s):"",o=i.slice(0,-1).every(p=>/^[0-9]+$/.test(p));return c===void 0||n&&s||c&&a||!o||r.slice(1).some(p=>Number(p)>=60)?null:{degrees:(c==="W"||c==="S"||a==="-"?-1:1)*(c==="O"?NaN:Ye(r)),point:c}}function Ye(e){if(e.length===1)return Number(e[0]);let t=10**(e[e.length-1].split(".")[1]?.length??0);return e.reduce((n,s)=>60*n+Math.round(Number(s)*t),0)/(t*60**(e.length-1))}var be=/^[-+]?[1-9][0-9]{0,2}[.,][0-9]{3}$/,Je=/^[-+]?0[0-9]/,Ke={longitude:"EWO",latitude:"NS"};function Ze(e){let[t,n]=["x","y"].map(s=>e.filter(a=>a.trim().toLowerCase()===s));return t.length===1&&n.length===1?[t[0],n[0]]:e.length===2?[e[0],e[1]]:null}function Qe(e,t,n){let s=t==="plane"?we(e.columns):"",a=o=>_e(o,s)?NaN:ve(o),[i,r]=n.map((o,l)=>t==="lonlat"?et(e,o,["longitude","latitude"][l]):xe(e,o,e.columns.get(o),"a number without a mark between thousands",a)),c=Float64Array.from({length:2*i.length},(o,l)=>(l%2===0?i:r)[l>>1]);return t==="lonlat"?ye(c,e.wrong):c}function ye(e,t){for(let n=0;n<e.length/2;++n){let[s,a]=e.subarray(2*n,2*n+2);t.has(n)||Math.abs(a)<=90&&Math.abs(s)<=360||t.set(n,`longitude ${s}, latitude ${a} is not on Earth; are they swapped, or not in degrees?`)}return e}function Xe(e,t){let n=we(e),s=c=>P.test(c)&&!Je.test(c)&&!_e(c,n),a=c=>E(c)||s(c.trim()),i=[...e].filter(([c,o])=>!t.has(c)&&o.every(a)&&!o.every(E)),r=c=>E(c)?NaN:Se(c.trim());return new Map(i.map(([c,o])=>[c,Float64Array.from(o,r)]))}function we(e){let n=[...e.values()].flatMap(s=>s.filter(a=>/[.,]/.test(a))).map(s=>s.trim()).filter(s=>P.test(s)&&!be.test(s));return[...new Set(n.map($e))].join("")||"."}var $e=e=>e.includes(",")?",":".",_e=(e,t)=>be.test(e)&&$e(e)!==t,Se=e=>Number(e.replace(",","."));function et(e,t,n){let s=Ke[n],a=`degrees with a sign, ${s[0]} or ${s[1]}`;return xe(e,n,tt(e,t,s),a,i=>{let r=P.test(i)?null:qe(i);return r===null?ve(i):s.includes(r.point)?r.degrees:NaN})}function tt({columns:e},t,n){let[s,a]=[e.get(t),[...e.keys()]],i=a[a.indexOf(t)+1]??"";if(!Ue.test(i))return s;let r=e.get(i).map(l=>E(T(l))?"":T(l)),c=r.filter(Boolean).map(l=>me(l)??"?");return!(c.length>0&&c.every(l=>n.includes(l)))||s.some(l=>T(l).includes("-")&&!E(l))?s:s.map((l,d)=>E(l)?"":`${l} ${r[d]}`.trim())}var ve=e=>P.test(e)?Se(e):NaN;function xe({wrong:e},t,n,s,a){return Float64Array.from(n,(i,r)=>{let c=i.trim(),o=a(c);return Number.isFinite(o)?o:(e.has(r)||e.set(r,`the ${t} is ${E(c)?"missing":`'${c}', not ${s}`}`),NaN)})}var nt=[",",";","	","|"],st=50,at=20,ke=/\r\n|\n|\r/,ot=/^(?:[ \t]*#[^\r\n]*(?:\r\n?|\n|$))+/;function it(e){let t=e.replace(ot,""),n=rt(t),a=(n===null?t.split(ke).map(Ee):[...lt(t,n)]).filter(f=>f.some(u=>u.trim()!==""));if(a.length===0)throw new _("the table is empty");let{names:i,data:r}=ct(a),c=r.length<a.length,o=i.find((f,u)=>f!==""&&i.indexOf(f)!==u);if(o!==void 0)throw new _(`there are several columns with the name '${o}'`);let l=i.map(()=>[]),d=new Map,p=i.reduce((f,u,b)=>u===""?f:b+1,0);r.forEach((f,u)=>{f.length>=p&&f.slice(i.length).every(y=>y==="")||d.set(u,`it has ${f.length} in place of ${i.length} fields`),l.forEach((y,O)=>y.push(f[O]??""))});let g=i.map((f,u)=>[f||`column_${u+1}`,l[u]]).filter(([,f],u)=>i[u]!==""||f.some(b=>b!==""));return{columns:new Map(g),count:r.length,isHeaded:c,wrong:d}}function rt(e){let t=e.split(ke,st).filter(o=>o.trim()!==""),n=t.map(o=>o.replace(/"[^"]*"/g,"")),a=nt.map(o=>({mark:o,widths:n.map(l=>l.split(o).length)})).filter(({widths:o})=>Math.max(0,...o)>1),i=a.filter(({widths:o})=>new Set(o).size===1),r=[...new Set(t.map(o=>Ee(o).length))];if(a.length===0||i.length===0&&r.length===1&&r[0]>1)return null;let c=({widths:o})=>Math.max(...o.map(l=>l>1?1e6*o.filter(d=>d===l).length+l:0));return(i.length>0?i:a).reduce((o,l)=>c(l)>c(o)?l:o).mark}var Ee=e=>e.trim().split(/\s+/);function*lt(e,t){let n=`[^"\\${t}\\r\\n][^\\${t}\\r\\n]*`,s=new RegExp(`(?:"([^"]*(?:""[^"]*)*)"|(${n})?)(\\${t}|\\r\\n|\\n|\\r|$)`,"y"),a=[];for(;s.lastIndex<e.length;){let i=s.lastIndex,r=s.exec(e);if(r===null)throw new _(`in ${e.slice(i,i+20)}… a quotation mark does not end a field; write it twice`);a.push(r[1]?.replaceAll('""','"')??r[2]??""),r[3]!==t&&(yield a,a=[])}a.length>0&&(yield[...a,""])}function ct(e){let t=e.slice(0,at).map(l=>l.map(d=>d.trim())),n=t.map(l=>l.filter(d=>d!=="")),s=l=>P.test(l),a=n.findIndex((l,d)=>U(l)!==null&&(d===0||!l.some(s))),i=n.findIndex(l=>l.length>1),r=Math.max(0,a>=0?a:i);return a<0&&2*n[r].filter(s).length>n[r].length?{names:t[r].length===2?["lon","lat"]:t[r].map((l,d)=>`column_${d+1}`),data:e.slice(r)}:{names:t[r],data:e.slice(r+1)}}function dt(e,t,n=null,s=new Map){let a=o=>typeof o=="string"?/[",\r\n]/.test(o)?`"${o.replaceAll('"','""')}"`:o:Object.is(o,-0)?"-0.0":Number.isFinite(o)?String(o):"",i=new Map([...n?[["name",n]]:[],...s]),r=[...e,...i.keys()],c=Array.from({length:t.length/2},(o,l)=>[t[2*l],t[2*l+1],...Array.from(i.values(),d=>d[l])]);return[r,...c].map(o=>`${o.map(a).join()}
`).join("")}var _=class extends Error{columns;constructor(e,t=[]){super(e),this.columns=t}};function pt(e){let t=ft(e),n=k(t,"type")==="Feature"?[t]:k(t,"features");if(!Array.isArray(n))throw new _("the file is not a GeoJSON FeatureCollection of points");let s=new Map,a=n.map((l,d)=>{let p=ut(l);return typeof p=="string"&&s.set(d,p),typeof p=="string"?[NaN,NaN]:p}),i=ye(Float64Array.from(a.flat()),s),r=n.map(l=>k(l,"properties")),c=new Set(r.flatMap(l=>Object.keys(l??{}))),o=new Map([...c].map(l=>[l,r.map(d=>ht(k(d,l)))]));return{places:i,table:{columns:o,count:n.length,isHeaded:!0,wrong:s}}}function ht(e){return typeof e=="object"?JSON.stringify(e??void 0)??"":String(e??"")}function k(e,t){return typeof e=="object"&&e!==null?e[t]:void 0}function ft(e){try{return JSON.parse(e)}catch(t){throw new _(`the file is not JSON: ${t instanceof Error?t.message:String(t)}`)}}function ut(e){let t=k(e,"geometry"),[n,s]=[k(t,"type"),k(t,"coordinates")],a=n==="MultiPoint"&&Array.isArray(s)&&s.length===1;if(n!=="Point"&&!a)return`a Point is needed, not ${typeof n=="string"?n:"no geometry"}`;let i=a?s[0]:s,r=Array.isArray(i)?i.slice(0,2):[];return r.length===2&&r.every(Number.isFinite)?r:`a Point has two or three coordinates, not ${JSON.stringify(i)}`}var de=1e6;function gt(e,t,n,s){let a=yt(t,e),i=/^\s*[{[]/.test(a);if(i&&n==="plane")return{room:"globe"};let r=i?pt(a):bt(a,n,s);if("room"in r)return r;let{places:c,table:o,axes:l=[]}=r,{count:d,wrong:p}=o;if(d===0)throw new _("there are no points");if(d>de){let b=`the page takes up to ${x(de)}; for more there is the Python library`;throw new _(`there are ${x(d)} points; ${b}`)}let h=p.size===0?"":mt(o);if(p.size===d)throw new _(h);let g=(b,y)=>!p.has(y),f=new Map([...o.columns].map(([b,y])=>[b,y.filter(g)])),u=[...f.keys()].find(b=>b.trim().toLowerCase()==="name")??"";return{file:e,places:c.filter((b,y)=>g(0,y>>1)),names:f.get(u)??null,values:Xe(f,new Set([...l,u])),leftOut:p.size,wrong:h}}function mt({count:e,wrong:t}){let n=[...t.keys()].reduce((a,i)=>Math.min(a,i));return`${t.size===e?"No row can":`${x(t.size)} of ${x(e)} rows cannot`} be placed. Row ${x(n+1)}: ${t.get(n)}`}function bt(e,t,n){let s=it(e),a=[...s.columns.keys()],i=s.isHeaded?U(a,!0):null,r=n??(t==="lonlat"?U(a):Ze(a));if(r===null&&i!==null)return{room:"globe"};if(r===null)throw new _("the table has no two columns of coordinates",a);let c=Qe(s,t,r),o=[...s.wrong.keys()].filter(l=>Number.isFinite(c[2*l]+c[2*l+1]));return t==="lonlat"&&i===null&&2*o.length>s.count?{room:"lift",columns:r}:{places:c,table:s,axes:r}}function yt(e,t){let n=String.fromCharCode(...e.subarray(0,2)),s=/^(\xff\xfe|[^\0]\0)/.test(n)?"utf-16le":/^(\xfe\xff|\0)/.test(n)?"utf-16be":null,a=s===null?["utf-8","windows-1252"]:[s];for(let c of a)try{let o=new TextDecoder(c,{fatal:!0}).decode(e),l=c==="windows-1252";if(!/\0|^\s*</.test(o)&&!(l&&Fe.test(o)))return o}catch{}let i=/^[\w.-]+$/.test(t)?t:`"${t}"`,r="neither a picture nor a table in text that the page can read";throw new _(`${r}; to make a page of it, type: stereodel web ${i}`)}async function Le(e,t,n,s,a){if(e.type.startsWith("image/"))return n.pass("globe",e);let{messages:i}=n,r=`${e.name}:`,c=o=>`${o}${/[.?!]$/.test(o)?"":"."} Nothing has changed.`;try{let o=gt(e.name,new Uint8Array(await e.arrayBuffer()),t,a);if("room"in o)return n.pass(o.room,e,o.columns);let{leftOut:l,wrong:d}=o,p=()=>{i.close(),s(o)};if(l===0)return p();let h=l===1?"this row":`these ${x(l)} rows`;i.show(r,c(d),{words:`Open without ${h}`,act:p})}catch(o){if(!(o instanceof _))throw o;let{message:l,columns:d}=o;if(d.length<2)return i.show(r,c(l));let p=(t==="lonlat"?["Longitude","Latitude"]:["x","y"]).map((g,f)=>{let u=w("select","",...d.map(b=>w("option","",b)));return u.selectedIndex=f,w("label","field column",`${g} `,u)}),h=()=>{let[g,f]=p.map(u=>J(u,"select").value);return Le(e,t,n,s,[g,f])};i.show(`Which columns of ${e.name}?`,"",{words:"Open",act:()=>{h()}},p)}}var wt=7;function $t(e,t="spherical"){return`{"type":"FeatureCollection","features":[
${e.map(({properties:s,corners:a})=>{let i=a.length===0?_t:St(a,t);return JSON.stringify({type:"Feature",properties:s,geometry:i})}).join(`,
`)}
]}
`}var _t={type:"Polygon",coordinates:[[...te(-180,-90,180,90),[-180,-90]]]};function St(e,t){let n=vt(e.flatMap((r,c)=>ae(r,e[(c+1)%e.length])),t),s=Math.round((n[n.length-1][0]-n[0][0])/360),a=r=>Number(r.toFixed(wt)),i=kt(n,s).map(r=>[r.map(([c,o])=>[a(c),a(o)])]);return i.length===1?{type:"Polygon",coordinates:i[0]}:{type:"MultiPolygon",coordinates:i}}function vt(e,t){let n=oe(Float64Array.from([...e,e[0]].flatMap(R)),t),s=[];for(let a=0;a<n.length;a+=2){let i=s[s.length-1]?.[0]??n[a];s.push([n[a]+360*Math.round((i-n[a])/360),n[a+1]])}return s}function xt(e,t,n){return e[0]===t[0]?e[1]:e[1]+(n-e[0])/(t[0]-e[0])*(t[1]-e[1])}function kt(e,t){let n=e.slice(1).map(([p,h])=>[p+360*t,h]),[[s],a]=[e[0],90*t],i=t===0?e:[...e,...n,[s+720*t,a],[s,a],e[0]],r=t===0?e.map(([p])=>p):[s,s+720*t],c=(Math.min(...r)+180)/360,o=t===0?Math.floor(c):Math.ceil(c),l=t===0?Math.ceil((Math.max(...r)+180)/360):o+1,d=[];for(let p=o;p<Math.max(l,o+1);++p){let h=i.slice(0,-1).map(([f,u])=>[f-360*p,u]),g=pe(pe(h,-180,1),180,-1);g.length>2&&d.push([...g,g[0]])}return d}function pe(e,t,n){let s=[];return e.forEach((a,i)=>{let r=e[(i+1)%e.length],[c,o]=[n*(a[0]-t)>=0,n*(r[0]-t)>=0];c&&s.push(a),c!==o&&a[0]!==t&&r[0]!==t&&s.push([t,xt(a,r,t)])}),s}var he=Float64Array.of(-Math.PI,-Math.PI/2,Math.PI,Math.PI/2),fe=2**15,Et=class{width;height;texels;levels;constructor(e,t){if(this.width=z(t,"width",2,2**20),this.height=t/2,e.length!==4*this.width*this.height){let a=`four for each of ${t} × ${this.height} pixels: a picture of the whole globe`;throw new RangeError(`pixels has ${e.length} numbers, and not ${a} is twice as wide as high`)}this.texels=new F(Lt(e));let n=ie(a=>a.call("raster_levels_size",this.width,this.height)),s=[this.texels,this.width,this.height,he];this.levels=new F(H(Uint8Array,n,"raster_levels",...s))}warp(e,t){return this.painted(e,[-1,1,2/t,2/t],t,t)}painted(e,t,n,s,a=!0){z(n,"width",1,fe),z(s,"height",1,fe);let i=e.inverse(),r=Float64Array.of(...i.right.matrix,i.magnification,...i.left.matrix,0),o=[...[this.texels,this.levels,this.width,this.height,he],r,Float64Array.of(...t),n,s,a?1:0];return H(Uint8ClampedArray,4*n*s,"warp_raster",...o)}};function Lt(e){let t=Uint8Array.from(e);for(let n=0;n<t.length;++n)n%4!==3&&(t[n]=Math.floor((t[n]*t[n|3]+127)/255));return t}var Rt=4096,Re=384,Pt=2,Ot=.3,Dt=.01;async function Nt(e,t,n){let s=await createImageBitmap(e).catch(()=>null);if(s===null||Math.abs(s.width/s.height-2)>Dt){let c=s&&`is ${s.width} × ${s.height}; one of the whole sphere is twice as wide as high`;t.show(`${e.name}:`,`the picture ${c??"cannot be read"}. Nothing has changed.`);return}let a=[],i=s,r=Math.round(Math.min(s.width,Rt)/2);do{let c=w("canvas",{width:2*r,height:r}),o=c.getContext("2d",{willReadFrequently:!0});o.drawImage(i,0,0,2*r,r),a.push(o.getImageData(0,0,2*r,r)),[i,r]=[c,Math.round(r/2)]}while(2*r>=Re);s.close(),t.close(),n(new At(e.name,a))}var At=class{name;#e;letters={ink:"rgb(255, 255, 255)",accent:"rgb(245, 160, 98)",halo:"rgb(24 26 28 / 0.55)"};constructor(e,t){this.name=e,this.#e=t.map(({data:n,width:s})=>new Et(n,s))}draw(e,t,n,s){let a=Math.max(1,Math.ceil(2*t.r*(s?Ot:Math.min(Pt,devicePixelRatio)))),i=({width:l})=>!s||l<=Re*n.magnification,r=this.#e.find(i)??this.#e[this.#e.length-1],c=new ImageData(r.painted(n,[-1,1,2/a,2/a],a,a,!1),a,a),o=w("canvas",{width:a,height:a});o.getContext("2d").putImageData(c,0,0),e.within({region:l=>se(l,t)},()=>e.picture(o,t.x-t.r,t.y-t.r,2*t.r,2*t.r))}},G={ink:"ink",halo:"paper",size:24,align:"center"},ue={...G,ink:"ink-2",size:13};async function Pe(e,t){let{width:n,paint:s,owner:a}=e;if(!a)return e;let i=ge(a.title,1.9*n/G.size),r=i.length*30+(i.length>0?6:0),c=new Image;if(a.legend){let p=a.legend.replace("<svg ",`<svg color="${t}" font-family='${A}' `);c.src=`data:image/svg+xml,${encodeURIComponent(p)}`,await c.decode()}let o=r+e.height+8,l=ge(a.source,2.1*n/ue.size),d=o+c.height;return{...e,title:a.title?`${a.title}. ${e.title}`:e.title,height:d+(l.length>0?l.length*17+10:0),paint(p){i.forEach((h,g)=>p.label(h,n/2,26+30*g,G)),p.within({corner:[0,r]},()=>s(p)),a.legend&&p.picture(c,(n-c.width)/2,o,c.width,c.height),l.forEach((h,g)=>p.label(h,n/2,d+14+17*g,ue))}}}function ge(e,t){let n=[];for(let s of e.split(/\s+/).filter(Boolean)){let a=n[n.length-1];a!==void 0&&a.length+s.length<t?n[n.length-1]=`${a} ${s}`:n.push(s)}return n}var Mt=`from dataclasses import replace

import numpy as np
from stereodel import SphereCircle, SphericalDelaunay, SphericalVoronoi, bubble_to_bubble, fisheye, lonlat_to_xyz
from stereodel.drawing import ColorScale, DotStyle, LineStyle, SizeScale, View, as_color
from stereodel.globe import Globe, Panel, panels
from stereodel.interpolation import contours
from stereodel.io import read_points

RED, WASH = LineStyle("#d55e00", 1.8), "#d55e0021"
radius = 1.349  # of circles of 150 km, degrees
[!bubble] focus = {focus}
[!bubble] lens = fisheye(focus, magnification={magnification})
[bubble] taken, filled = SphereCircle.around({taken}), SphereCircle.around({filled})
[bubble] lens = bubble_to_bubble(taken, filled)
[owned] table = {file}  # as the page exports it; the page draws over 1000 lines weaker where dense
[owned] places = table.lonlat
[!owned places] places = {places}
[scaled] values, scale = table.column({valued}), {scale}
[scaled isolines] net = SphericalDelaunay.from_lonlat(places{latitude})
[scaled isolines] levels = [tick for tick in scale.ticks if scale.low < tick < scale.high]
[scaled isolines] isolines = [line.lonlat for line in contours(net, values, levels)]
[scaled fills] shades = scale(values)
[owned !scaled] shades = {shades}


def earth():
    globe = Globe(ocean="#dde9f1", limb=LineStyle("#4d4d4d", 1.3){latitude}{title})
[picture]     globe.add_raster({picture})
[!picture land]     globe.add_land(color="#f4eddd", resolution="{resolution}")
[!picture land]     globe.add_coastlines(style=LineStyle("#405466", 0.7), resolution="{resolution}")
[owned fills]     globe.add_cells(SphericalVoronoi.from_lonlat(places{latitude}), colors=shades, style=None)
[owned fills !picture]     globe.add_coastlines(style=LineStyle("#405466", 0.7), resolution="{resolution}")
[graticule]     globe.add_graticule(10, style=LineStyle("#a9b5be", 0.5))
[tissot]     globe.add_tissot(10, radius, color="#40546629", style=LineStyle("#405466", 0.6))
[places cells]     cells = SphericalVoronoi.from_lonlat(places{latitude})
[places cells]     globe.add_cells(cells, style=LineStyle("#1b1b1b", 1.1))
[scaled isolines]     for style in (LineStyle("#fdfcfa", 2.4), LineStyle("#1b1b1b", 0.8)):
[scaled isolines]         globe.add_lines(isolines, style=style, name="isolines")
[owned]     globe.add_points(places, {points})
[places !owned]     globe.add_points(places, style=DotStyle("#1b1b1b", 2.5, "#fdfcfa", 0.6))
[pointed]     globe.add_circles([SphereCircle.around({pointer}, radius)], color=WASH, style=RED)
[named names]     globe.add_labels(places, {words}, size=13.0, movable=True)
    return globe


[!bubble] globe = earth()
[!bubble !owned] globe.add_points([focus], style=DotStyle("#fdfcfa", 5.9, RED.color, 1.8))
[!bubble !owned] globe.add_labels([focus], ["focus"], offset=(9.0, 7.0), color="#ab4300", font="italic", size=15.0)
[!bubble !owned] page = globe.page(lens, View({view}), width={width})
[!bubble owned] page = globe.page(lens, View({view}), width={width}, legend=True)
[bubble] before, after = earth(), earth()
[bubble] before.add_circles([taken], color=WASH, style=RED, name="rim")
[bubble] after.add_circles([taken], color=None, style=RED, name="rim")
[bubble] page = panels([Panel(before, None, View({before})), Panel(after, lens, View({view}))], width={width})
[bubble] page = replace(page, items=tuple(sorted(page.items, key=lambda item: item.name == "rim")))  # over the limb
replace(page.shaded(0.7), background=as_color("#fdfcfa")).save("globe.svg")
`,zt=`import numpy as np

from stereodel import PlanarDelaunay, PlanarVoronoi, SphereArc, SphereCircle, SphericalDelaunay, SphericalVoronoi, Stereographic, in_bubble
from stereodel.drawing import DotStyle, LineStyle, Polylines, Scene, Sketch, View

points = {points}
low, high = {corners}  # of the sheet
middle, diagonal = (low + high) / 2, np.hypot(*(high - low)) or 1.0
corners = np.array([low, [high[0], low[1]], high, [low[0], high[1]]])
sheet, view = PlanarDelaunay(points), View({view})
width, height, scale, contact = {width}, {height}, {scale}, np.array([{contact}])  # scale: of a diagonal
INK, GRAY, RED = LineStyle("#1b1b1b", 1.1), LineStyle("#7b7b7b", 0.9), LineStyle("#d55e00", 1.8)
HULL, SIDE, LIMB = LineStyle("#6d8598", 1.3), LineStyle("#7b7b7b", 1.3), LineStyle("#4d4d4d", 0.7)
PAPER, RAY, DOT = "#fdfcfa", LineStyle("#d55e00", 0.8, (5.0, 4.0)), DotStyle("#1b1b1b", 2.5, "#fdfcfa", 0.6)
sketch = Sketch()


def in_plane(xy):
    """Where places of the sheet are on the picture, before they are lifted."""
    uv = scale * (xy - middle) / diagonal
    return contact + view.project(np.concatenate([uv, 0 * uv[..., :1]], axis=-1))


[seeing facets] def hatch(chosen):
[seeing facets]     """Lines 45° steep, 6 points apart, where places of the picture are chosen."""
[seeing facets]     reach = np.hypot(width, height) / 2
[seeing facets]     along, across = np.arange(-reach, reach), np.arange(-reach, reach, 6.0)[:, None]
[seeing facets]     places = np.stack([along - across, along + across], axis=-1) / np.sqrt(2) + [width / 2, height / 2]
[seeing facets]     row, end = np.nonzero(np.diff(chosen(places), axis=1, prepend=False, append=False))
[seeing facets]     ends = places[row, np.minimum(end, len(along) - 1)].reshape(-1, 2, 2)
[seeing facets]     sketch.add_segments(ends, name="hatch", style=LineStyle("#9db0c0", 0.8))


[flat seeing facets] def outside(places):
[flat]     axes = np.linalg.inv(view.project(np.eye(3)[:2]))
[flat]     xy = (places - contact) @ axes * diagonal / scale + middle
[flat]     return ((low <= xy) & (xy <= high)).all(axis=-1) & (sheet.find_simplex(xy.reshape(-1, 2)).reshape(xy.shape[:2]) < 0)


[flat] sketch.add_polygon(in_plane(corners), name="sheet", color="#9db4c847")
[flat seeing facets] hatch(outside)
[flat seeing facets] sketch.add_edges(in_plane(points), sheet.convex_hull, name="hull", style=HULL)
[flat triangles] sketch.add_edges(in_plane(points), sheet.edges, name="delaunay", style=INK)
[flat cells facets] sketch.add_segments(in_plane(PlanarVoronoi(sheet).segments((*low, *high))[0]), name="voronoi", style=GRAY)
[flat] sketch.add_polyline(in_plane(corners), closed=True, name="side", style=SIDE)
[flat] images = in_plane(points)
[flat pair] sketch.add_segment(*images[[{pair}]], name="span", style=RED)
[flat] sketch.add_points(images, name="sites", style=DOT)
[!flat] radius = scale / (4 * np.tan(np.radians({corner}) / 2))
[!flat] projection, center = Stereographic((-90, 90), radius=radius), np.array([0.0, 0.0, -radius])


[!flat] def lifted(xy):
[!flat]     return projection.inverse(scale * (xy - middle) / diagonal)


[!flat] def outside(places):
[!flat]     axes = view.raised((places - contact - view.project(center)) / radius).reshape(-1, 3)
[!flat]     chosen, seen = np.zeros(len(axes), dtype=bool), np.isfinite(axes[:, 2])
[!flat]     xy = projection.forward(axes[seen] @ view.matrix) * diagonal / scale + middle
[!flat]     chosen[seen] = sheet.find_simplex(np.nan_to_num(xy, nan=1e300, posinf=1e300, neginf=-1e300)) < 0
[!flat]     return chosen.reshape(places.shape[:2])


[!flat] xyz = lifted(points)
[!flat] front, glass, span = (Scene(radius=radius, center=center, style=style, limb=LIMB) for style in ("solid", "glass", "none"))
[!flat seeing facets] uv = (points - middle) * 2.0 ** -np.round(np.log2(diagonal))  # rays that are exact
[!flat seeing facets] hull = SphericalDelaunay(np.column_stack([2 * uv, 1 - (uv**2).sum(axis=1)]))
[!flat seeing facets] closing = hull.simplices[in_bubble(*hull.points[hull.simplices].swapaxes(0, 1), (0, 0, -1)) >= 0]
[!flat seeing facets] front.add_edges(xyz, closing[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), name="hull", style=HULL)
[!flat] sketch.add_items(item for item in front.layout(view, at=contact) if item.name in {shown})
[!flat seeing facets] hatch(outside)
[!flat area] ends = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
[!flat area] through = lifted(np.stack([ends[:, 0], ends.mean(axis=1), ends[:, 1]], axis=1))
[!flat area] sides = [SphereArc(SphereCircle.through(*three), three[0], three[2]) for three in through]
[!flat area] glass.add_region(sides, name="sheet", color="#9db4c847")
[!flat triangles] glass.add_edges(xyz, sheet.edges, name="delaunay", style=INK)
[!flat area] glass.add_arcs(sides, name="side", style=SIDE)
[!flat] sketch.add_items(item for item in glass.layout(view, at=contact) if item.name not in ("ball", "limb"))
[!flat cells facets] steps = np.stack([arc.sample(65) for arc in SphericalVoronoi(xyz).ridge_arcs()], axis=1)
[!flat cells facets] xy = projection.forward(steps) * diagonal / scale + middle
[!flat cells facets] inside = ((low <= xy) & (xy <= high)).all(axis=-1) & (view.depth(steps) >= 0)
[!flat cells facets] pieces = np.stack([steps[:-1], steps[1:]], axis=2)[inside[:-1] & inside[1:]].reshape(-1, 3)
[!flat cells facets] lines = contact + view.project(center + radius * pieces)
[!flat cells facets] sketch.add_items([Polylines(lines, np.arange(0, len(lines) + 1, 2), GRAY.color, GRAY.width, "voronoi")])
[!flat] images = contact + view.project(center + radius * xyz)
[!flat] sketch.add_points(images[view.depth(xyz) >= 0], name="sites", style=DOT)
[!flat] sketch.add_polygon(in_plane(corners), name="plane", color="#9db4c819")
[!flat] sketch.add_polyline(in_plane(corners), closed=True, name="frame", style=LIMB)
[!flat triangles] sketch.add_edges(in_plane(points), sheet.edges, name="flat", style=LineStyle("#1b1b1b61", 1.1))
[!flat] for arm in ([4.5, 0.0], [0.0, 3.5]):
[!flat]     sketch.add_segment(contact - arm, contact + arm, name="contact", style=LineStyle("#1b1b1b", 1.0))
[!flat pair] span.add_edges(xyz, [[{pair}]], name="span", style=RED)
[!flat pair] sketch.add_items(span.layout(view, at=contact))
[!flat pole] pole = contact + view.project(2 * center)
[letters] for site, letter in zip([{pair}], "PQ"):
[letters]     above = in_plane(points[site])
[!flat letters rays pole]     sketch.add_segment(pole, above, name="ray", style=RAY)
[!flat letters rays !pole]     sketch.add_segment(images[site], above, name="ray", style=RAY)
[letters !flat]     sketch.add_points(above, name="shadow", style=DotStyle(PAPER, 2.8, RED.color, 1.2))
[letters]     sketch.add_points(images[site], name="held", style=DotStyle(RED.color, 3.7, PAPER, 1.0))
[letters]     sketch.add_label(above, f"\${letter}$", (0.0, 9.0), valign="baseline", size=17.0, color="#ab4300")
[!flat pole] sketch.add_points(pole, name="pole", style=DotStyle("#1b1b1b", 2.3, PAPER, 0.6))
sketch.page((0, width, 0, height), width=width, background=PAPER).shaded(0.33).save("lift.svg")
`,Tt=`import numpy as np

from stereodel import PlanarDelaunay, PlanarVoronoi, PlaneLine, SphereArc, SphereCircle, SphericalDelaunay, SphericalVoronoi, Stereographic, fisheye, in_bubble, lonlat_to_xyz
from stereodel.data import airports, cities, stars
from stereodel.drawing import DotStyle, Fill, LineStyle, Scene, Sketch, View, as_color
from stereodel.io import read_points
from stereodel.triangulation import planar_part

lonlat = {sites}
delaunay = SphericalDelaunay.from_lonlat(lonlat)
points, pole, view = delaunay.points, lonlat_to_xyz(({pole})), View({view})
[facets] sees_pole = in_bubble(*points[delaunay.simplices].swapaxes(0, 1), pole) >= 0
[facets] triangles = delaunay.simplices[~sees_pole]  # those of the plane
[facets] sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
[facets] edges, count = np.unique(sides, axis=0, return_counts=True)  # those of the hull are sides of one triangle

size, ball, gap = {size}, {ball}, {gap}  # of each picture, of the ball, between the pictures
left, right = np.array([0.5 * size, 0.5 * size]), np.array([1.5 * size + gap, 0.5 * size])
frame = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * (size / 2 - 1)
projection = Stereographic(-pole, radius=frame.max() / {reach})
shift = frame.max() / {reach} * np.array([{middle}])
flat = projection.forward(points) - shift
flat[(points == pole).all(axis=1)] = 1e9  # a site at the pole is far away
lens = fisheye({lens})
scene, sketch = Scene(limb=LineStyle("#4d4d4d", 1.3)), Sketch()
INK, GRAY, HULL = LineStyle("#1b1b1b", 1.1), LineStyle("#7b7b7b", 0.9), LineStyle("#6d8598", 1.3)
RED, WASH, PAPER = LineStyle("#d55e00", 1.8), "#d55e0021", "#fdfcfa"
DOT, HELD = DotStyle("#1b1b1b", 2.5, PAPER, 0.6), DotStyle(RED.color, 3.7, PAPER, 1.0)


def arcs(pairs):
    """Great circles between sites, through the lens."""
    return [lens.image_of(SphereArc.great(points[a], points[b])) for a, b in pairs]


def path(corners):
    return np.linspace(corners, np.roll(corners, -1, axis=0), 4, axis=1)


[hatched facets] along, across = np.arange(-size, size), np.arange(-size, size, 6.0)[:, None]
[hatched facets] steep = np.stack([along - across, along + across], axis=-1) / np.sqrt(2)  # lines, 6 points apart


[hatched facets] def hatch(middle, chosen, lines=steep):
[hatched facets]     """The parts of lines of a picture that are chosen."""
[hatched facets]     row, end = np.nonzero(np.diff(chosen(lines), axis=1, prepend=False, append=False))
[hatched facets]     ends = middle + lines[row, np.minimum(end, len(along) - 1)].reshape(-1, 2, 2)
[hatched facets]     sketch.add_segments(ends, name="hatch", style=LineStyle("#9db0c0", 0.8))


[hatched facets] def on_ball(facets, beyond):
[hatched facets]     """Chooses what lies on some facets, and beyond all triangles of the sphere or not."""
[hatched facets]     def chosen(places):
[hatched facets]         axes, found = view.raised(places / ball), np.zeros(places.shape[:2], dtype=bool)
[hatched facets]         seen = np.isfinite(axes[..., 2])
[hatched facets]         found[seen] = np.append(facets, beyond)[delaunay.find_simplex(lens.inverse()(axes[seen] @ view.matrix))]
[hatched facets]         return found
[hatched facets]     return chosen


[seeing facets] hull = PlanarDelaunay(flat[np.unique(triangles)])
[seeing facets] hatch(right, lambda places: hull.find_simplex(places.reshape(-1, 2)).reshape(places.shape[:2]) < 0)
[triangles facets] sketch.add_edges(right + flat, edges, name="delaunay", style=INK)
[triangles facets] scene.add_arcs(arcs(delaunay.edges), name="delaunay", style=INK)
[cells facets] ridges, _ = PlanarVoronoi(flat[np.unique(triangles)]).segments((-size, -size, size, size))
[cells facets] sketch.add_segments(right + ridges, name="voronoi", style=GRAY)
[cells] ridge_arcs = map(lens.image_of, SphericalVoronoi(delaunay).ridge_arcs())
[cells] scene.add_arcs(ridge_arcs, name="voronoi", style=GRAY)
[seeing facets] sketch.add_edges(right + flat, edges[count == 1], name="hull", style=HULL)
[seeing facets] scene.add_arcs(arcs(edges[count == 1]), name="hull", style=HULL)
[bubble aimed] triangle = delaunay.simplices[delaunay.find_simplex(lonlat_to_xyz(({aim})))]
[bubble aimed] bubble, pairs = SphereCircle.through(*points[triangle]), np.column_stack([triangle, np.roll(triangle, -1)])
[bubble aimed] scene.add_cap(lens.image_of(bubble), name="bubble", color=WASH)
[bubble aimed] scene.add_circles([lens.image_of(bubble)], style=RED)
[bubble aimed] scene.add_arcs(arcs(pairs), name="triangle", style=LineStyle(RED.color, 1.2))
[bubble aimed] image = projection.image_of(bubble)
[bubble aimed] if isinstance(image, PlaneLine):
[bubble aimed]     far = 9 * size * image.direction
[bubble aimed]     sketch.add_segment(right - shift + image.point - far, right - shift + image.point + far, name="circle", style=RED)
[bubble aimed] else:
[bubble aimed]     paths = [path(right - shift + image.sample(720))] + [path(right + frame)] * image.outside
[bubble aimed]     sketch.add_items([Fill(tuple(paths), as_color(WASH), "bubble")])
[bubble aimed]     sketch.add_circle(right - shift + image.center, image.radius, name="circle", style=RED)
[bubble aimed]     if not image.outside:
[bubble aimed]         sketch.add_edges(right + flat, pairs, name="triangle", style=LineStyle(RED.color, 1.2))
[step] before, new = SphericalDelaunay(points[: {step} - 1]), {step} - 1
[step] opened = before.simplices[in_bubble(*points[before.simplices].swapaxes(0, 1), points[new]) > 0]
[step] sides = opened[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2).tolist()
[step] fan = np.array([[a, b, new] for a, b in sides if [b, a] not in sides], dtype=int).reshape(-1, 3)
[step] flat_fan = fan[in_bubble(*points[fan].swapaxes(0, 1), pole) < 0]
[step] for corners in fan[np.linalg.det(points[fan]) > 0].tolist():  # others close the hull
[step]     scene.add_region(arcs(zip(corners, corners[1:] + corners[:1])), name="opened", color=WASH)
[step] for corners in flat_fan:
[step]     sketch.add_polygon(right + flat[corners], name="opened", color=WASH)
[step] planar = planar_part(before, pole)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
[step] scene.add_arcs(arcs(before.edges), name="delaunay", style=INK)
[step] sketch.add_edges(right + flat, np.unique(np.sort(planar, axis=1), axis=0), name="delaunay", style=INK)
[step] scene.add_arcs(arcs(fan[:, [2, 0]]), name="fan", style=LineStyle(RED.color, 1.0, (4.0, 3.0)))
[step] spokes = np.unique(flat_fan[:, [2, 0, 2, 1]].reshape(-1, 2), axis=0)
[step] sketch.add_edges(right + flat, spokes, name="fan", style=LineStyle(RED.color, 1.0, (4.0, 3.0)))
[step] scene.add_arcs(arcs(fan[:, :2]), name="horizon", style=RED)
[step] sketch.add_edges(right + flat, flat_fan[:, :2], name="horizon", style=RED)
sketch.add_points((right + flat)[:{step}], name="sites", style=DOT)
scene.add_points(lens(points)[:{step}], name="sites", style=DOT)
[held] sketch.add_points((right + flat)[[{held}]], name="held", style=HELD)
[held] scene.add_points(lens(points)[[{held}]], name="held", style=HELD)
around = Fill((path(right + 9 * frame), path(right + frame)), as_color(PAPER), "paper")
sketch.add_items([around]).add_polyline(right + frame, closed=True, name="frame", style=LineStyle("#4d4d4d", 0.7))
ground, *items = scene.layout(view, at=left, scale=ball)
sketch.add_items([ground])
[seeing facets] hatch(left, on_ball(sees_pole, (sees_pole & delaunay.closing).any()))
[closing hemisphere] for lines in (steep, steep * [1, -1]):
[closing hemisphere]     hatch(left, on_ball(delaunay.closing, True), lines)
sketch.add_items(items)
[pole] at = left + ball * view.project(lens(pole))
[pole front] sketch.add_points(at, name="pole", style=DotStyle(PAPER, 5.9, RED.color, 1.8))
[pole !front] sketch.add_circle(at, 5.0, name="pole", style=LineStyle(RED.color, 1.2))
[pole] sketch.add_label(at, "$P$", (11.0 if at[0] < left[0] else -11.0, 0.0), size=15.0, color="#ab4300")
page = sketch.page((0, 2 * size + gap, 0, size), width=2 * size + gap, background=PAPER)
page.shaded(0.33).save("sphere.svg")
`,Oe=200,De="cities().lonlat[cities().population >= 2_000_000]",It=`SphericalDelaunay.from_lonlat(airports().lonlat).nearest(lonlat=${De})`,jt={cities:De,airports:`airports().lonlat[np.unique(${It})]`,stars:"stars().lonlat[stars().magnitude <= 3.0]"};function Ct(e,t,n,s){let{sites:a,view:i,bubble:r,aim:c,step:o}=e,l=re(e.map,e.twin),d=f=>o===null&&e.isOn(f),p=[...d("bubble")&&r?.sites||[],...o===null?e.held:[o.site]],h={facets:a.facetCount>0,hemisphere:a.hasClosing,step:o!==null&&o.before.dimension===2,aimed:r!==null,held:p.length>0,pole:l!==null,front:l!==null&&l[2]>=0,hatched:d("seeing")||d("closing")&&a.hasClosing},g={...s,sites:jt[n.set]??B(a.lonlat,`${Ne(n.file)}.lonlat`),pole:$(t.pole),view:$(i.middle),aim:R(c).join(", "),lens:`(${$(R(t.lens.focus))}), magnification=${t.lens.magnification}`,held:p.join(", "),step:o===null?"":o.site+1};return V(Tt,g,h,d)}function Ft(e,t,n,s){let{sites:a,sheet:i,view:r,isOn:c}=e,[o,l]=[e.p,e.q].filter(u=>u!==null),{contact:d,height:p}=t,h=a.count===0?[3,2]:s,g={facets:a.delaunay.dimension===2,flat:i.isFlat,area:a.rectangle.width>0&&a.rectangle.height>0,letters:o!==void 0,pair:l!==void 0&&o!==l,pole:t.seenPole!==null},f={points:B(a.places,`np.loadtxt(${JSON.stringify(n.file)}, delimiter=",", skiprows=1, usecols=(0, 1))`),corners:h?`np.array([[-1, -1], [1, 1]]) * [${$(h)}] / 2`:"points.min(axis=0), points.max(axis=0)",view:$(r.middle),width:t.width,height:p,scale:t.scale,contact:`${d[0]}, ${p-d[1]}`,corner:i.corner,pair:[o,l].join(", "),shown:JSON.stringify(t.grounds)};return V(zt,f,g,c)}function Ht(e,t,n,s,a){let{lens:i,sight:r,from:c,to:o,before:l,after:d,pointer:p}=e,{places:h,latitude:g,picture:f,resolution:u}=t,b=i==="bubble",{owner:y,names:O,lonlat:q=new Float64Array(0)}=h??{},I=Ne(h?.name??""),j=h===null||g==="spherical"?"":`, latitude="${g}"`,D=C=>{let N=`(${$(R(C))})`;return j===""?N:`lonlat_to_xyz(${N}${j})`},Y=({middle:C,roll:N})=>$([...C,N]).replace(/, -?0$/,""),Ae={focus:D(r.lens.focus),magnification:$([r.lens.magnification]),taken:`${D(c.center)}, ${$([c.radius])}`,filled:`${D(o.center)}, ${$([o.radius])}`,title:"",...y?.lines,file:I,places:B(q,`${I}.lonlat`),words:q.length>2*Oe?`${I}.column("name")`:JSON.stringify(O),latitude:j,picture:JSON.stringify(f?.name??""),resolution:u,pointer:D(p),before:Y(l),view:Y(b?d:r.view),width:$([1.03*s*(b?2:1)])},{points:Me,scale:ze}=y?.lines??{};return V(Mt,Ae,{bubble:b,picture:f,places:h,pointed:a,owned:Me,scaled:ze,named:O},n)}function V(e,t,n,s){let a=l=>l in n?!!n[l]:s(l),r=e.split(`
`).flatMap(l=>{let[,d,p]=/^(?:\[([!a-z ]+)\] )?(.*)$/.exec(l);return d?.split(" ").every(g=>g.startsWith("!")?!a(g.slice(1)):a(g))===!1?[]:[p]}).join(`
`).replace(/\{(\w+)\}/g,(l,d)=>String(t[d]??l)),c=r.replace(/^(from|import) .*\n/gm,""),o=l=>new RegExp(`\\b${l.split(" as ").pop()}\\b`).test(c);return r.replace(/^((?:from \S+ )?import )(.*)\n/gm,(l,d,p)=>{let h=p.split(", ").filter(o);return h.length===0?"":`${d}${h.join(", ")}
`})}function B(e,t){if(e.length>2*Oe)return`${t}  # the page draws over 1000 lines weaker where dense`;let n=Array.from({length:e.length/2},(a,i)=>`[${e[2*i]}, ${e[2*i+1]}]`),s=n.join(", ").replace(/(.{1,82}\],) /g,`$1
    `);return n.length===0?"np.zeros((0, 2))":`np.array([
    ${s},
])`}var Ne=e=>`read_points(${JSON.stringify(e)})`;function $(e){return e.map(t=>M(t,7)).join(", ")}function Wt(e,t){let n=new Blob([t]),s=w("a",{href:URL.createObjectURL(n),download:e});s.click(),setTimeout(()=>URL.revokeObjectURL(s.href),6e4)}async function Ut(e){let{title:t,width:n,height:s,paint:a}=await Pe(e,L().ink),i=new je(n,s,L());return a(i),i.text(t)}async function Gt(e,t){let{width:n,height:s,paint:a}=await Pe(e,L().ink),i=w("canvas",{width:Math.round(n*t),height:Math.round(s*t)}),r=i.getContext("2d");return r.fillStyle=L().paper,r.fillRect(0,0,i.width,i.height),a(new K(r,n,s,t,L())),new Promise((c,o)=>{i.toBlob(l=>l===null?o(new Error("the picture is too large")):c(l))})}async function Vt(e,t){let n=e.cloneNode(!0);n.querySelector("#block-state")?.remove();let s=new Blob([t]).stream().pipeThrough(new CompressionStream("deflate")),a=new Uint8Array(await new Response(s).arrayBuffer()),i=btoa(Array.from(a,r=>String.fromCharCode(r)).join(""));return n.querySelector("#block-kernel").before(w("script",{type:"text/plain",id:"block-state"},i),`
`),new Blob([`<!doctype html>
`,n.outerHTML,`
`],{type:"text/html"})}var Bt={csv:dt,download:Wt,geojson:$t,globePython:Ht,liftPython:Ft,openPanorama:Nt,openPoints:Le,savedPage:Vt,sheetPng:Gt,sheetSvg:Ut,spherePython:Ct};Object.assign(document.currentScript,{offers:Bt});})();
