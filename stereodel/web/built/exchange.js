(()=>{var{find:X,make:w}=document.currentScript.shared;var{CanvasPen:K}=document.currentScript.shared;var{HALO_WIDTH:J,SERIF:N,STYLES:Z,colours:R}=document.currentScript.shared;var{writeNumber:O}=document.currentScript.shared;var{LIGHT:Q,Pen:ee,cornersOf:te,textParts:ne,traceDisc:se}=document.currentScript.shared;var{counted:S}=document.currentScript.shared;var{along:ae}=document.currentScript.shared;var{tableLonlat:oe}=document.currentScript.shared;var{lonLatOf:L}=document.currentScript.shared;var{asCount:M}=document.currentScript.shared;var{Kept:F,filled:U,run:re}=document.currentScript.shared;var{poleSeen:ie}=document.currentScript.shared;var Ie=3,ze=3,je=class extends ee{#t=[];#e=[];text(e){let[n,t]=[m(this.width),m(this.height)];return`${[`<svg xmlns="http://www.w3.org/2000/svg" width="${n}" height="${t}" viewBox="0 0 ${n} ${t}">`,`<title>${H(e)}</title>`,...this.#t.length>0?[`<defs>${this.#t.join("")}</defs>`]:[],`<rect width="${n}" height="${t}" ${x("fill",this.colours.paper)}/>`,`<g fill="none" stroke-linecap="round" stroke-linejoin="round" font-family='${N}'>`,...this.#e].join(`
`)}
</g>
</svg>
`}path(e,n,t,s){let a=le(n);if(a==="")return;let o=[];s.fill!==void 0&&o.push(x("fill",t??this.colours[s.fill],s.fillOpacity)),s.stroke!==void 0&&o.push(this.#n(s,t)),this.#e.push(`<path class="${e}" ${o.join(" ")} d="${a}"/>`)}within({opacity:e=1,region:n,corner:t},s){let a=`clip-${this.#t.length}`;n&&this.#t.push(`<clipPath id="${a}"><path d="${le(n)}"/></clipPath>`);let o=n?` clip-path="url(#${a})"`:"",i=e<1?` opacity="${e}"`:"",l=t?` transform="translate(${t.map(m).join(" ")})"`:"";this.#e.push(`<g${o}${i}${l}>`),s(),this.#e.push("</g>")}discs(e,n,t){let{radius:s,fill:a,rim:o,rimWidth:i,opacity:l}=n,r=m(s-i/2),c=`dots-${this.#t.length}`,d=[];for(let p=0;p<t.length;p+=2)d.push(`<circle cx="${m(t[p])}" cy="${m(t[p+1])}" r="${r}"/>`);this.#t.push(`<g id="${c}">${d.join("")}</g>`);let h=`fill="none" ${x("stroke",this.colours[o],l)} stroke-width="${m(2*i)}"`;this.#e.push(`<use class="${e}-rim" href="#${c}" ${h}/>`),this.#e.push(`<use class="${e}" href="#${c}" ${x("fill",this.colours[a],l)}/>`)}spots(e,n){let t=this.#n(Z["spot-line"]);n.forEach((s,a)=>{let[o,i,l]=[e[3*a],e[3*a+1],e[3*a+2]].map(m);this.#e.push(`<circle class="spot" cx="${o}" cy="${i}" r="${l}" ${x("fill",s)} ${t}/>`)})}label(e,n,t,s){let a={left:"start",center:"middle",right:"end"}[s.align??"left"],o=ne(e,s.italic??!1).map(r=>r.italic?`<tspan font-style="italic">${H(r.text)}</tspan>`:H(r.text)).join(""),i=`paint-order="stroke" ${x("stroke",this.inkOf(s.halo))} stroke-width="${J}"`,l=`x="${m(n)}" y="${m(t)}" font-size="${s.size}" text-anchor="${a}"`;this.#e.push(`<text ${l} ${x("fill",this.inkOf(s.ink))} ${i}>${o}</text>`)}picture(e,n,t,s,a){if(e instanceof HTMLImageElement){let l=decodeURIComponent(e.src.slice(e.src.indexOf(",")+1));return this.within({corner:[n,t]},()=>this.#e.push(l))}let o=document.createElement("canvas");[o.width,o.height]=[e.width,e.height],o.getContext("2d").drawImage(e,0,0);let i=`x="${m(n)}" y="${m(t)}" width="${m(s)}" height="${m(a)}"`;this.#e.push(`<image ${i} preserveAspectRatio="none" href="${o.toDataURL("image/png")}"/>`)}#n(e,n=this.colours[e.stroke??"ink"]){let t=e.dash===void 0?"":` stroke-dasharray="${e.dash.join(" ")}"`;return`${x("stroke",n,e.strokeOpacity)} stroke-width="${m(e.width??1)}"${t}`}fillDisc({x:e,y:n,r:t},s){let a=typeof s=="string"?x("fill",s):`fill="url(#${s.id})"`;if(this.#e.push(`<circle ${a} cx="${m(e)}" cy="${m(n)}" r="${m(t)}"/>`),typeof s=="string")return;let o=s.stops.map(([r,c])=>`<stop offset="${r}" ${x("stop-color",c,1,"stop-opacity")}/>`),i=Object.entries(Q).map(([r,c])=>`${r}="${m((c+(r==="r"?0:1))/2)}"`),l=`<radialGradient id="${s.id}" ${i.join(" ")}>${o.join("")}</radialGradient>`;this.#t.includes(l)||this.#t.push(l)}};function le(e){let n="";return e({moveTo:(t,s)=>n+=`M${m(t)} ${m(s)}`,lineTo:(t,s)=>n+=`L${m(t)} ${m(s)}`,ellipse(t,s,a,o,i,l,r,c=!1){let[d,h]=[Math.cos(i),Math.sin(i)],p=u=>{let[b,y]=[a*Math.cos(u),o*Math.sin(u)];return[t+b*d-y*h,s+b*h+y*d]};n===""?this.moveTo(...p(l)):this.lineTo(...p(l));let g=Math.ceil(Math.abs(r-l)/ze),f=`${m(a)} ${m(o)} ${m(i*180/Math.PI)} 0 ${c?0:1}`;for(let u=1;u<=g;++u){let[b,y]=p(l+(r-l)*u/g);n+=`A${f} ${m(b)} ${m(y)}`}},closePath:()=>n+="Z"}),n}function m(e){return O(e,Ie)}function x(e,n,t=1,s=`${e}-opacity`){let[a,o,i,l=1]=(n.match(/[\d.]+/g)??[]).map(Number),r=l*t,c=r===1?"":` ${s}="${m(r)}"`;return`${e}="rgb(${a}, ${o}, ${i})"${c}`}function H(e){return e.replace(/&/g,"&amp;").replace(/</g,"&lt;").replace(/>/g,"&gt;")}var $={lon:["longitude","lon","lng","long","longitud","longitudine","längengrad","laengengrad","долгота","经度","經度","経度","خط الطول"],lat:["latitude","lat","latitud","latitudine","breitengrad","широта","纬度","緯度","خط العرض"],unsure_lon:["x","xcoord","länge","laenge","الطول"],unsure_lat:["y","ycoord","breite","العرض"],beside:["coord","coords","coordinate","coordinates","point","geo","geogr","geographische","deg","degrees","grad"],missing:["","na","n/a","#n/a","nan","null","none","<na>","-","–"],compass:{E:"East Ost Osten Est Este Leste в.д. 东经 東経 شرقا",W:"West Westen Ouest Oeste Ovest з.д. 西经 西経 غربا",N:"North Nord Norden Norte с.ш. 北纬 北緯 شمالا",S:"South Süd Süden Sud Sur Sul ю.ш. 南纬 南緯 جنوبا"},lettered:"n\\W?s|e\\W?w|[nsew]|\\w*hem\\w*|\\w*(?:lat|lon)\\w*(?:ns|ew|[nsew]|dir|ref)|column_\\d+",zeros:"٠۰０",printed:"−–   　٫．，،",typed:"--    ..,,",unseen:"​‎‏\uFEFF",western:"°ºªà-öø-ÿÀ-ÖØ-ß€‘’“”–—«»²³µ ŒœŠšŽžŸ"},P=/^[-+]?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:e[-+]?[0-9]+)?$/i,Ce=new Set($.missing),k=e=>Ce.has(e.trim().toLowerCase()),Fe=new RegExp(`\\0|[^\\x00-\\x7f${$.western}]|[^\\x00-\\x7f]{3}`),Ue="぀";function W(e,n=!1){let[t,s]=["lon","lat"].map(a=>{let[o,i]=[$[a],$[`unsure_${a}`]],c=[d=>o.includes(d),(d,h)=>o.some(p=>h.includes(p)||p>Ue&&d.includes(p)),(d,h)=>h.length>0&&h.every(p=>i.includes(p))].slice(0,n?2:3).map(d=>e.filter(h=>d(h.trim().toLowerCase(),He(h)))).find(d=>d.length>0);return c?.length===1?c[0]:null});return t===null||s===null||t===s?null:[t,s]}function He(e){return e.replace(/(?<=[a-z])(?=[A-Z])/g," ").toLowerCase().split(/[^\p{L}]+/u).filter(t=>t!==""&&!$.beside.includes(t))}var We=new RegExp(`^(?:${$.lettered})$`,"iu"),Ge=new RegExp(`[${$.printed}${$.unseen}]`,"gu");function I(e){return e.replace(Ge,t=>$.typed[$.printed.indexOf(t)]??"").trim().replace(/\s+/g," ")}var Ve=new Map(Object.entries({...$.compass,O:"O"}).flatMap(([e,n])=>[e,...n.toLowerCase().split(" ")].map(t=>[t,e]))),ge=e=>Ve.get(e.length>1?e.toLowerCase():e),ce="[0-9]+(?:[.,][0-9]*)?",qe=new RegExp(`^(?<before>[\\p{L}.]+)?\\s*(?<sign>[-+])?\\s*(?<degrees>[0-9]{1,3}(?:[.,][0-9]*)?)(?:\\s*(?:deg(?:rees?)?|[°º˚d:度]|\\s)\\s*(?:(?<minutes>${ce})(?:\\s*(?:min|['′’‘´m:分]|\\s)\\s*(?:(?<seconds>${ce})\\s*(?:''|’’|′′|["″”“秒]|sec|s)?)?)?)?)?\\s*(?<after>[\\p{L}.]+)?$`,"u");function Be(e){let n=e.length>200?null:qe.exec(I(e))?.groups;if(!n)return null;let{before:t,after:s,sign:a}=n,o=[n.degrees,n.minutes,n.seconds].filter(h=>h!==void 0),i=o.map(h=>h.replace(",",".").replace(/\.$/,"")),l=t??s?ge(t??s):"",r=o.slice(0,-1).every(h=>/^[0-9]+$/.test(h));return l===void 0||t&&s||l&&a||!r||i.slice(1).some(h=>Number(h)>=60)?null:{degrees:(l==="W"||l==="S"||a==="-"?-1:1)*(l==="O"?NaN:Ye(i)),point:l}}function Ye(e){if(e.length===1)return Number(e[0]);let n=10**(e[e.length-1].split(".")[1]?.length??0);return e.reduce((t,s)=>60*t+Math.round(Number(s)*n),0)/(n*60**(e.length-1))}var be=/^[-+]?[1-9][0-9]{0,2}[.,][0-9]{3}$/,Xe=/^[-+]?0[0-9]/,Ke={longitude:"EWO",latitude:"NS"};function Je(e){let[n,t]=["x","y"].map(s=>e.filter(a=>a.trim().toLowerCase()===s));return n.length===1&&t.length===1?[n[0],t[0]]:e.length===2?[e[0],e[1]]:null}function Ze(e,n,t){let s=n==="plane"?we(e.columns):"",a=r=>ve(r,s)?NaN:xe(r),[o,i]=t.map((r,c)=>n==="lonlat"?et(e,r,["longitude","latitude"][c]):Se(e,r,e.columns.get(r),"a number without a mark between thousands",a)),l=Float64Array.from({length:2*o.length},(r,c)=>(c%2===0?o:i)[c>>1]);return n==="lonlat"?ye(l,e.wrong):l}function ye(e,n){for(let t=0;t<e.length/2;++t){let[s,a]=e.subarray(2*t,2*t+2);n.has(t)||Math.abs(a)<=90&&Math.abs(s)<=360||n.set(t,`longitude ${s}, latitude ${a} is not on Earth; are they swapped, or not in degrees?`)}return e}function Qe(e,n){let t=we(e),s=l=>P.test(l)&&!Xe.test(l)&&!ve(l,t),a=l=>k(l)||s(l.trim()),o=[...e].filter(([l,r])=>!n.has(l)&&r.every(a)&&!r.every(k)),i=l=>k(l)?NaN:$e(l.trim());return new Map(o.map(([l,r])=>[l,Float64Array.from(r,i)]))}function we(e){let t=[...e.values()].flatMap(s=>s.filter(a=>/[.,]/.test(a))).map(s=>s.trim()).filter(s=>P.test(s)&&!be.test(s));return[...new Set(t.map(_e))].join("")||"."}var _e=e=>e.includes(",")?",":".",ve=(e,n)=>be.test(e)&&_e(e)!==n,$e=e=>Number(e.replace(",","."));function et(e,n,t){let s=Ke[t],a=`degrees with a sign, ${s[0]} or ${s[1]}`;return Se(e,t,tt(e,n,s),a,o=>{let i=P.test(o)?null:Be(o);return i===null?xe(o):s.includes(i.point)?i.degrees:NaN})}function tt({columns:e},n,t){let[s,a]=[e.get(n),[...e.keys()]],o=a[a.indexOf(n)+1]??"";if(!We.test(o))return s;let i=e.get(o).map(c=>k(I(c))?"":I(c)),l=i.filter(Boolean).map(c=>ge(c)??"?");return!(l.length>0&&l.every(c=>t.includes(c)))||s.some(c=>I(c).includes("-")&&!k(c))?s:s.map((c,d)=>k(c)?"":`${c} ${i[d]}`.trim())}var xe=e=>P.test(e)?$e(e):NaN;function Se({wrong:e},n,t,s,a){return Float64Array.from(t,(o,i)=>{let l=o.trim(),r=a(l);return Number.isFinite(r)?r:(e.has(i)||e.set(i,`the ${n} is ${k(l)?"missing":`'${l}', not ${s}`}`),NaN)})}var nt=[",",";","	","|"],st=50,at=20,Ee=/\r\n|\n|\r/,ot=/^(?:[ \t]*#[^\r\n]*(?:\r\n?|\n|$))+/;function rt(e){let n=e.replace(ot,""),t=it(n),a=(t===null?n.split(Ee).map(ke):[...lt(n,t)]).filter(f=>f.some(u=>u.trim()!==""));if(a.length===0)throw new v("the table is empty");let{names:o,data:i}=ct(a),l=i.length<a.length,r=o.find((f,u)=>f!==""&&o.indexOf(f)!==u);if(r!==void 0)throw new v(`there are several columns with the name '${r}'`);let c=o.map(()=>[]),d=new Map,h=o.reduce((f,u,b)=>u===""?f:b+1,0);i.forEach((f,u)=>{f.length>=h&&f.slice(o.length).every(y=>y==="")||d.set(u,`it has ${f.length} in place of ${o.length} fields`),c.forEach((y,A)=>y.push(f[A]??""))});let g=o.map((f,u)=>[f||`column_${u+1}`,c[u]]).filter(([,f],u)=>o[u]!==""||f.some(b=>b!==""));return{columns:new Map(g),count:i.length,isHeaded:l,wrong:d}}function it(e){let n=e.split(Ee,st).filter(r=>r.trim()!==""),t=n.map(r=>r.replace(/"[^"]*"/g,"")),a=nt.map(r=>({mark:r,widths:t.map(c=>c.split(r).length)})).filter(({widths:r})=>Math.max(0,...r)>1),o=a.filter(({widths:r})=>new Set(r).size===1),i=[...new Set(n.map(r=>ke(r).length))];if(a.length===0||o.length===0&&i.length===1&&i[0]>1)return null;let l=({widths:r})=>Math.max(...r.map(c=>c>1?1e6*r.filter(d=>d===c).length+c:0));return(o.length>0?o:a).reduce((r,c)=>l(c)>l(r)?c:r).mark}var ke=e=>e.trim().split(/\s+/);function*lt(e,n){let t=`[^"\\${n}\\r\\n][^\\${n}\\r\\n]*`,s=new RegExp(`(?:"([^"]*(?:""[^"]*)*)"|(${t})?)(\\${n}|\\r\\n|\\n|\\r|$)`,"y"),a=[];for(;s.lastIndex<e.length;){let o=s.lastIndex,i=s.exec(e);if(i===null)throw new v(`in ${e.slice(o,o+20)}… a quotation mark does not end a field; write it twice`);a.push(i[1]?.replaceAll('""','"')??i[2]??""),i[3]!==n&&(yield a,a=[])}a.length>0&&(yield[...a,""])}function ct(e){let n=e.slice(0,at).map(c=>c.map(d=>d.trim())),t=n.map(c=>c.filter(d=>d!=="")),s=c=>P.test(c),a=t.findIndex((c,d)=>W(c)!==null&&(d===0||!c.some(s))),o=t.findIndex(c=>c.length>1),i=Math.max(0,a>=0?a:o);return a<0&&2*t[i].filter(s).length>t[i].length?{names:n[i].length===2?["lon","lat"]:n[i].map((c,d)=>`column_${d+1}`),data:e.slice(i)}:{names:n[i],data:e.slice(i+1)}}function dt(e,n,t=null,s=new Map){let a=r=>typeof r=="string"?/[",\r\n]/.test(r)?`"${r.replaceAll('"','""')}"`:r:Object.is(r,-0)?"-0.0":Number.isFinite(r)?String(r):"",o=new Map([...t?[["name",t]]:[],...s]),i=[...e,...o.keys()],l=Array.from({length:n.length/2},(r,c)=>[n[2*c],n[2*c+1],...Array.from(o.values(),d=>d[c])]);return[i,...l].map(r=>`${r.map(a).join()}
`).join("")}var v=class extends Error{columns;constructor(e,n=[]){super(e),this.columns=n}};function ht(e){let n=ft(e),t=E(n,"type")==="Feature"?[n]:E(n,"features");if(!Array.isArray(t))throw new v("the file is not a GeoJSON FeatureCollection of points");let s=new Map,a=t.map((c,d)=>{let h=ut(c);return typeof h=="string"&&s.set(d,h),typeof h=="string"?[NaN,NaN]:h}),o=ye(Float64Array.from(a.flat()),s),i=t.map(c=>E(c,"properties")),l=new Set(i.flatMap(c=>Object.keys(c??{}))),r=new Map([...l].map(c=>[c,i.map(d=>pt(E(d,c)))]));return{places:o,table:{columns:r,count:t.length,isHeaded:!0,wrong:s}}}function pt(e){return typeof e=="object"?JSON.stringify(e??void 0)??"":String(e??"")}function E(e,n){return typeof e=="object"&&e!==null?e[n]:void 0}function ft(e){try{return JSON.parse(e)}catch(n){throw new v(`the file is not JSON: ${n instanceof Error?n.message:String(n)}`)}}function ut(e){let n=E(e,"geometry"),[t,s]=[E(n,"type"),E(n,"coordinates")],a=t==="MultiPoint"&&Array.isArray(s)&&s.length===1;if(t!=="Point"&&!a)return`a Point is needed, not ${typeof t=="string"?t:"no geometry"}`;let o=a?s[0]:s,i=Array.isArray(o)?o.slice(0,2):[];return i.length===2&&i.every(Number.isFinite)?i:`a Point has two or three coordinates, not ${JSON.stringify(o)}`}var de=1e6;function mt(e,n,t,s){let a=yt(n,e),o=/^\s*[{[]/.test(a);if(o&&t==="plane")return{room:"globe"};let i=o?ht(a):bt(a,t,s);if("room"in i)return i;let{places:l,table:r,axes:c=[]}=i,{count:d,wrong:h}=r;if(d===0)throw new v("there are no points");if(d>de){let b=`the page takes up to ${S(de)}; for more there is the Python library`;throw new v(`there are ${S(d)} points; ${b}`)}let p=h.size===0?"":gt(r);if(h.size===d)throw new v(p);let g=(b,y)=>!h.has(y),f=new Map([...r.columns].map(([b,y])=>[b,y.filter(g)])),u=[...f.keys()].find(b=>b.trim().toLowerCase()==="name")??"";return{file:e,places:l.filter((b,y)=>g(0,y>>1)),names:f.get(u)??null,values:Qe(f,new Set([...c,u])),leftOut:h.size,wrong:p}}function gt({count:e,wrong:n}){let t=[...n.keys()].reduce((a,o)=>Math.min(a,o));return`${n.size===e?"No row can":`${S(n.size)} of ${S(e)} rows cannot`} be placed. Row ${S(t+1)}: ${n.get(t)}`}function bt(e,n,t){let s=rt(e),a=[...s.columns.keys()],o=s.isHeaded?W(a,!0):null,i=t??(n==="lonlat"?W(a):Je(a));if(i===null&&o!==null)return{room:"globe"};if(i===null)throw new v("the table has no two columns of coordinates",a);let l=Ze(s,n,i),r=[...s.wrong.keys()].filter(c=>Number.isFinite(l[2*c]+l[2*c+1]));return n==="lonlat"&&o===null&&2*r.length>s.count?{room:"lift",columns:i}:{places:l,table:s,axes:i}}function yt(e,n){let t=String.fromCharCode(...e.subarray(0,2)),s=/^(\xff\xfe|[^\0]\0)/.test(t)?"utf-16le":/^(\xfe\xff|\0)/.test(t)?"utf-16be":null,a=s===null?["utf-8","windows-1252"]:[s];for(let l of a)try{let r=new TextDecoder(l,{fatal:!0}).decode(e),c=l==="windows-1252";if(!/\0|^\s*</.test(r)&&!(c&&Fe.test(r)))return r}catch{}let o=/^[\w.-]+$/.test(n)?n:`"${n}"`,i="neither a picture nor a table in text that the page can read";throw new v(`${i}; to make a page of it, type: stereodel web ${o}`)}async function Re(e,n,t,s,a){if(e.type.startsWith("image/"))return t.pass("globe",e);let{messages:o}=t,i=`${e.name}:`,l=r=>`${r}${/[.?!]$/.test(r)?"":"."} Nothing has changed.`;try{let r=mt(e.name,new Uint8Array(await e.arrayBuffer()),n,a);if("room"in r)return t.pass(r.room,e,r.columns);let{leftOut:c,wrong:d}=r,h=()=>{o.close(),s(r)};if(c===0)return h();let p=c===1?"this row":`these ${S(c)} rows`;o.show(i,l(d),{words:`Open without ${p}`,act:h})}catch(r){if(!(r instanceof v))throw r;let{message:c,columns:d}=r;if(d.length<2)return o.show(i,l(c));let h=(n==="lonlat"?["Longitude","Latitude"]:["x","y"]).map((g,f)=>{let u=w("select","",...d.map(b=>w("option","",b)));return u.selectedIndex=f,w("label","field column",`${g} `,u)}),p=()=>{let[g,f]=h.map(u=>X(u,"select").value);return Re(e,n,t,s,[g,f])};o.show(`Which columns of ${e.name}?`,"",{words:"Open",act:()=>{p()}},h)}}var wt=7;function _t(e,n="spherical"){return`{"type":"FeatureCollection","features":[
${e.map(({properties:s,corners:a})=>{let o=a.length===0?vt:$t(a,n);return JSON.stringify({type:"Feature",properties:s,geometry:o})}).join(`,
`)}
]}
`}var vt={type:"Polygon",coordinates:[[...te(-180,-90,180,90),[-180,-90]]]};function $t(e,n){let t=xt(e.flatMap((l,r)=>ae(l,e[(r+1)%e.length])),n),s=Math.round((t[t.length-1][0]-t[0][0])/360),a=s===0?t:St(t,s),o=l=>Number(l.toFixed(wt)),i=Et(a).map(l=>[l.map(([r,c])=>[o(r),o(c)])]);return i.length===1?{type:"Polygon",coordinates:i[0]}:{type:"MultiPolygon",coordinates:i}}function xt(e,n){let t=oe(Float64Array.from([...e,e[0]].flatMap(L)),n),s=[];for(let a=0;a<t.length;a+=2){let o=s[s.length-1]?.[0]??t[a];s.push([t[a]+360*Math.round((o-t[a])/360),t[a+1]])}return s}function St(e,n){let t=n>0?90:-90,s=n>0?[...e]:[...e].reverse(),a=360*Math.ceil((s[0][0]-180)/360)+180,o=s.findIndex(([h])=>h>=a),i=Le(s[Math.max(0,o-1)],s[o===-1?s.length-1:o],a),l=s.slice(Math.max(o,0),-1).map(([h,p])=>[h-a-180,p]),r=s.slice(0,Math.max(o,0)).map(([h,p])=>[h-a+180,p]),c=[[-180,i],...l,...r,[180,i]],d=n>0?c:c.reverse();return[...d,[d[d.length-1][0],t],[d[0][0],t],d[0]]}function Le(e,n,t){return e[0]===n[0]?e[1]:e[1]+(t-e[0])/(n[0]-e[0])*(n[1]-e[1])}function Et(e){let n=e.map(([o])=>o),t=Math.floor((Math.min(...n)+180)/360),s=Math.ceil((Math.max(...n)+180)/360),a=[];for(let o=t;o<Math.max(s,t+1);++o){let i=e.slice(0,-1).map(([r,c])=>[r-360*o,c]),l=he(he(i,-180,1),180,-1);l.length>2&&a.push([...l,l[0]])}return a}function he(e,n,t){let s=[];return e.forEach((a,o)=>{let i=e[(o+1)%e.length],[l,r]=[t*(a[0]-n)>=0,t*(i[0]-n)>=0];l&&s.push(a),l!==r&&a[0]!==n&&i[0]!==n&&s.push([n,Le(a,i,n)])}),s}var pe=Float64Array.of(-Math.PI,-Math.PI/2,Math.PI,Math.PI/2),fe=2**15,kt=class{width;height;texels;levels;constructor(e,n){if(this.width=M(n,"width",2,2**20),this.height=n/2,e.length!==4*this.width*this.height){let a=`four for each of ${n} × ${this.height} pixels: a picture of the whole globe`;throw new RangeError(`pixels has ${e.length} numbers, and not ${a} is twice as wide as high`)}this.texels=new F(Rt(e));let t=re(a=>a.call("raster_levels_size",this.width,this.height)),s=[this.texels,this.width,this.height,pe];this.levels=new F(U(Uint8Array,t,"raster_levels",...s))}warp(e,n){return this.painted(e,[-1,1,2/n,2/n],n,n)}painted(e,n,t,s,a=!0){M(t,"width",1,fe),M(s,"height",1,fe);let o=e.inverse(),i=Float64Array.of(...o.right.matrix,o.magnification,...o.left.matrix,0),r=[...[this.texels,this.levels,this.width,this.height,pe],i,Float64Array.of(...n),t,s,a?1:0];return U(Uint8ClampedArray,4*t*s,"warp_raster",...r)}};function Rt(e){let n=Uint8Array.from(e);for(let t=0;t<n.length;++t)t%4!==3&&(n[t]=Math.floor((n[t]*n[t|3]+127)/255));return n}var Lt=4096,Pt=2,At=.25,Dt=.01;async function Tt(e,n,t){let s=await createImageBitmap(e).catch(()=>null);if(s===null||Math.abs(s.width/s.height-2)>Dt){let l=s&&`is ${s.width} × ${s.height}; one of the whole sphere is twice as wide as high`;n.show(`${e.name}:`,`the picture ${l??"cannot be read"}. Nothing has changed.`);return}let a=Math.round(Math.min(s.width,Lt)/2),o=w("canvas",{width:2*a,height:a}),i=o.getContext("2d",{willReadFrequently:!0});i.drawImage(s,0,0,o.width,o.height),s.close(),n.close(),t(new Nt(e.name,i.getImageData(0,0,o.width,o.height)))}var Nt=class{name;#t;#e;letters={ink:"rgb(255, 255, 255)",accent:"rgb(245, 160, 98)",halo:"rgb(24 26 28 / 0.55)"};constructor(e,n){this.name=e,this.#t=new kt(n.data,n.width),this.#e=It(n)}draw(e,n,t,s){let a=s&&this.#e===null?At:Math.min(Pt,devicePixelRatio),o=Math.max(1,Math.ceil(2*n.r*a)),i=s&&this.#e!==null?this.#e(t,o):this.#n(t,o);e.within({region:l=>se(l,n)},()=>e.picture(i,n.x-n.r,n.y-n.r,2*n.r,2*n.r))}#n(e,n){let t=w("canvas",{width:n,height:n}),s=new ImageData(this.#t.painted(e,[-1,1,2/n,2/n],n,n,!1),n,n);return t.getContext("2d").putImageData(s,0,0),t}},Ot=`#version 300 es
out vec2 place;
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
  gl_Position = vec4(place, 0.0, 1.0);
}`,Mt=`#version 300 es
precision highp float;
in vec2 place;
uniform sampler2D picture;
uniform mat3 left, right;
uniform float magnification;
out vec4 colour;
const float PI = 3.14159265358979;
void main() {
  float square = dot(place, place);
  vec3 seen = vec3(place, sqrt(max(0.0, 1.0 - square)));
  vec3 v = seen * left;
  float s = magnification, up = 1.0 + v.z, down = 1.0 - v.z;
  vec3 w = vec3(2.0 * s * v.xy, up - s * s * down) / (up + s * s * down) * right;
  vec2 at = vec2(atan(w.y, w.x) / (2.0 * PI) + 0.5, 0.5 - asin(clamp(w.z, -1.0, 1.0)) / PI);
  vec2 dx = dFdx(at), dy = dFdy(at);
  dx.x -= round(dx.x);
  dy.x -= round(dy.x);
  colour = square <= 1.02 ? textureGrad(picture, at, dx, dy) : vec4(0.0);
}`;function It(e){let n=w("canvas"),t=n.getContext("webgl2",{antialias:!1,depth:!1,alpha:!0});if(t===null||t.getParameter(t.MAX_TEXTURE_SIZE)<e.width)return null;let s=t.createProgram();for(let[a,o]of[[t.VERTEX_SHADER,Ot],[t.FRAGMENT_SHADER,Mt]]){let i=t.createShader(a);t.shaderSource(i,o),t.compileShader(i),t.attachShader(s,i)}return t.linkProgram(s),t.getProgramParameter(s,t.LINK_STATUS)?(t.useProgram(s),t.bindTexture(t.TEXTURE_2D,t.createTexture()),t.texImage2D(t.TEXTURE_2D,0,t.RGBA,t.RGBA,t.UNSIGNED_BYTE,e),t.generateMipmap(t.TEXTURE_2D),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MIN_FILTER,t.LINEAR_MIPMAP_LINEAR),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_S,t.REPEAT),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_T,t.CLAMP_TO_EDGE),({left:a,right:o,magnification:i},l)=>{n.width!==l&&(n.width=n.height=l),t.viewport(0,0,l,l);for(let[r,{matrix:c}]of Object.entries({left:a,right:o}))t.uniformMatrix3fv(t.getUniformLocation(s,r),!0,new Float32Array(c));return t.uniform1f(t.getUniformLocation(s,"magnification"),1/i),t.drawArrays(t.TRIANGLES,0,3),n}):null}var G={ink:"ink",halo:"paper",size:24,align:"center"},ue={...G,ink:"ink-2",size:13};async function Pe(e,n){let{width:t,paint:s,owner:a}=e;if(!a)return e;let o=me(a.title,1.9*t/G.size),i=o.length*30+(o.length>0?6:0),l=new Image;if(a.legend){let h=a.legend.replace("<svg ",`<svg color="${n}" font-family='${N}' `);l.src=`data:image/svg+xml,${encodeURIComponent(h)}`,await l.decode()}let r=i+e.height+8,c=me(a.source,2.1*t/ue.size),d=r+l.height;return{...e,title:a.title?`${a.title}. ${e.title}`:e.title,height:d+(c.length>0?c.length*17+10:0),paint(h){o.forEach((p,g)=>h.label(p,t/2,26+30*g,G)),h.within({corner:[0,i]},()=>s(h)),a.legend&&h.picture(l,(t-l.width)/2,r,l.width,l.height),c.forEach((p,g)=>h.label(p,t/2,d+14+17*g,ue))}}}function me(e,n){let t=[];for(let s of e.split(/\s+/).filter(Boolean)){let a=t[t.length-1];a!==void 0&&a.length+s.length<n?t[t.length-1]=`${a} ${s}`:t.push(s)}return t}var zt=`from dataclasses import replace

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
[owned] table = {file}  # as the page exports it
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
`,jt=`import numpy as np

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
`,Ct=`import numpy as np

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
`,Ae=200,De="cities().lonlat[cities().population >= 2_000_000]",Ft=`SphericalDelaunay.from_lonlat(airports().lonlat).nearest(lonlat=${De})`,Ut={cities:De,airports:`airports().lonlat[np.unique(${Ft})]`,stars:"stars().lonlat[stars().magnitude <= 3.0]"};function Ht(e,n,t,s){let{sites:a,view:o,bubble:i,aim:l,step:r}=e,c=ie(e.map,e.twin),d=f=>r===null&&e.isOn(f),h=[...d("bubble")&&i?.sites||[],...r===null?e.held:[r.site]],p={facets:a.facetCount>0,hemisphere:a.hasClosing,step:r!==null&&r.before.dimension===2,aimed:i!==null,held:h.length>0,pole:c!==null,front:c!==null&&c[2]>=0,hatched:d("seeing")||d("closing")&&a.hasClosing},g={...s,sites:Ut[t.set]??q(a.lonlat,`${Te(t.file)}.lonlat`),pole:_(n.pole),view:_(o.middle),aim:L(l).join(", "),lens:`(${_(L(n.lens.focus))}), magnification=${n.lens.magnification}`,held:h.join(", "),step:r===null?"":r.site+1};return V(Ct,g,p,d)}function Wt(e,n,t,s){let{sites:a,sheet:o,view:i,isOn:l}=e,[r,c]=[e.p,e.q].filter(u=>u!==null),{contact:d,height:h}=n,p=a.count===0?[3,2]:s,g={facets:a.delaunay.dimension===2,flat:o.isFlat,area:a.rectangle.width>0&&a.rectangle.height>0,letters:r!==void 0,pair:c!==void 0&&r!==c,pole:n.seenPole!==null},f={points:q(a.places,`np.loadtxt(${JSON.stringify(t.file)}, delimiter=",", skiprows=1, usecols=(0, 1))`),corners:p?`np.array([[-1, -1], [1, 1]]) * [${_(p)}] / 2`:"points.min(axis=0), points.max(axis=0)",view:_(i.middle),width:n.width,height:h,scale:n.scale,contact:`${d[0]}, ${h-d[1]}`,corner:o.corner,pair:[r,c].join(", "),shown:JSON.stringify(n.grounds)};return V(jt,f,g,l)}function Gt(e,n,t,s,a){let{lens:o,sight:i,from:l,to:r,before:c,after:d,pointer:h}=e,{places:p,latitude:g,picture:f,resolution:u}=n,b=o==="bubble",{owner:y,names:A,lonlat:B=new Float64Array(0)}=p??{},z=Te(p?.name??""),j=p===null||g==="spherical"?"":`, latitude="${g}"`,D=C=>{let T=`(${_(L(C))})`;return j===""?T:`lonlat_to_xyz(${T}${j})`},Y=({middle:C,roll:T})=>_([...C,T]).replace(/, -?0$/,""),Ne={focus:D(i.lens.focus),magnification:_([i.lens.magnification]),taken:`${D(l.center)}, ${_([l.radius])}`,filled:`${D(r.center)}, ${_([r.radius])}`,title:"",...y?.lines,file:z,places:q(B,`${z}.lonlat`),words:B.length>2*Ae?`${z}.column("name")`:JSON.stringify(A),latitude:j,picture:JSON.stringify(f?.name??""),resolution:u,pointer:D(h),before:Y(c),view:Y(b?d:i.view),width:_([1.03*s*(b?2:1)])},{points:Oe,scale:Me}=y?.lines??{};return V(zt,Ne,{bubble:b,picture:f,places:p,pointed:a,owned:Oe,scaled:Me,named:A},t)}function V(e,n,t,s){let a=c=>c in t?!!t[c]:s(c),i=e.split(`
`).flatMap(c=>{let[,d,h]=/^(?:\[([!a-z ]+)\] )?(.*)$/.exec(c);return d?.split(" ").every(g=>g.startsWith("!")?!a(g.slice(1)):a(g))===!1?[]:[h]}).join(`
`).replace(/\{(\w+)\}/g,(c,d)=>String(n[d]??c)),l=i.replace(/^(from|import) .*\n/gm,""),r=c=>new RegExp(`\\b${c.split(" as ").pop()}\\b`).test(l);return i.replace(/^((?:from \S+ )?import )(.*)\n/gm,(c,d,h)=>{let p=h.split(", ").filter(r);return p.length===0?"":`${d}${p.join(", ")}
`})}function q(e,n){if(e.length>2*Ae)return n;let t=Array.from({length:e.length/2},(a,o)=>`[${e[2*o]}, ${e[2*o+1]}]`),s=t.join(", ").replace(/(.{1,82}\],) /g,`$1
    `);return t.length===0?"np.zeros((0, 2))":`np.array([
    ${s},
])`}var Te=e=>`read_points(${JSON.stringify(e)})`;function _(e){return e.map(n=>O(n,7)).join(", ")}async function Vt(e,n){let t=e.cloneNode(!0);t.querySelector("#block-state")?.remove();let s=w("script",{type:"text/plain",id:"block-state"},await qt(n));return t.querySelector("#block-kernel").before(s,`
`),new Blob([`<!doctype html>
`,t.outerHTML,`
`],{type:"text/html"})}async function qt(e){let n=new Blob([e]).stream().pipeThrough(new CompressionStream("deflate")),t=new Uint8Array(await new Response(n).arrayBuffer());return btoa(Array.from(t,s=>String.fromCharCode(s)).join(""))}function Bt(e,n){let t=new Blob([n]),s=w("a",{href:URL.createObjectURL(t),download:e});s.click(),setTimeout(()=>URL.revokeObjectURL(s.href),6e4)}async function Yt(e){let{title:n,width:t,height:s,paint:a}=await Pe(e,R().ink),o=new je(t,s,R());return a(o),o.text(n)}async function Xt(e,n){let{width:t,height:s,paint:a}=await Pe(e,R().ink),o=w("canvas",{width:Math.round(t*n),height:Math.round(s*n)}),i=o.getContext("2d");return i.fillStyle=R().paper,i.fillRect(0,0,o.width,o.height),a(new K(i,t,s,n,R())),new Promise((l,r)=>{o.toBlob(c=>c===null?r(new Error("the picture is too large")):l(c))})}var Kt={csv:dt,download:Bt,geojson:_t,globePython:Gt,liftPython:Wt,openPanorama:Tt,openPoints:Re,savedPage:Vt,sheetPng:Xt,sheetSvg:Yt,spherePython:Ht};Object.assign(document.currentScript,{offers:Kt});})();
