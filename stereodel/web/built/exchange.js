(()=>{var{make:$}=document.currentScript.shared;var{CanvasPen:te}=document.currentScript.shared;var{BEHIND:ne,HALO_WIDTH:se,HATCH_PITCH:ae,HATCH_WIDTH:oe,SERIF:re,STYLES:ie,colours:C}=document.currentScript.shared;var{writeNumber:z}=document.currentScript.shared;var{LIGHT:le,Pen:ce,cornersOf:j,textParts:de,traceCorners:he,traceSegment:V}=document.currentScript.shared;var{counted:k}=document.currentScript.shared;var{along:pe}=document.currentScript.shared;var{tableLonlat:ue}=document.currentScript.shared;var{lonLatOf:A}=document.currentScript.shared;var{asCount:H}=document.currentScript.shared;var{Kept:q,filled:X,kernel:fe}=document.currentScript.shared;var Je=3,Ye=3,Ke=class extends ce{#t=[];#e=[];text(e){let[t,n]=[w(this.width),w(this.height)];return`${[`<svg xmlns="http://www.w3.org/2000/svg" width="${t}" height="${n}" viewBox="0 0 ${t} ${n}">`,`<title>${J(e)}</title>`,...this.#t.length>0?[`<defs>${this.#t.join("")}</defs>`]:[],`<rect width="${t}" height="${n}" ${S("fill",this.colours.paper)}/>`,`<g fill="none" stroke-linecap="round" stroke-linejoin="round" font-family='${re}'>`,...this.#e].join(`
`)}
</g>
</svg>
`}path(e,t,n,s){let a=ge(n);if(a==="")return;let o=[];t.hatch!==void 0&&o.push(`fill="url(#${this.#r(t.hatch)})"`),t.fill!==void 0&&o.push(S("fill",s??this.colours[t.fill],t.fillOpacity)),t.stroke!==void 0&&o.push(this.#n(t,s)),this.#e.push(`<path class="${e}" ${o.join(" ")} d="${a}"/>`)}behind(e){this.#s(`opacity="${ne}"`,e)}clipped(e,t){let n=`clip-${this.#t.length}`;this.#t.push(`<clipPath id="${n}"><path d="${ge(e)}"/></clipPath>`),this.#s(`clip-path="url(#${n})"`,t)}discs(e,t,n){let{radius:s,fill:a,rim:o,rimWidth:r,opacity:l}=t,i=w(s-r/2),c=`dots-${this.#t.length}`,d=[];for(let p=0;p<n.length;p+=2)d.push(`<circle cx="${w(n[p])}" cy="${w(n[p+1])}" r="${i}"/>`);this.#t.push(`<g id="${c}">${d.join("")}</g>`);let h=`fill="none" ${S("stroke",this.colours[o],l)} stroke-width="${w(2*r)}"`;this.#e.push(`<use class="${e}-rim" href="#${c}" ${h}/>`),this.#e.push(`<use class="${e}" href="#${c}" ${S("fill",this.colours[a],l)}/>`)}spots(e,t){let n=this.#n(ie["spot-line"]);t.forEach((s,a)=>{let[o,r,l]=[e[3*a],e[3*a+1],e[3*a+2]].map(w),i=s==="transparent"?"":` ${S("fill",s)}`;this.#e.push(`<circle class="spot" cx="${o}" cy="${r}" r="${l}"${i} ${n}/>`)})}lowered(e,t){this.#s(`transform="translate(0 ${w(e)})"`,t)}label(e,t,n,s){let a={left:"start",center:"middle",right:"end"}[s.align??"left"],o=de(e,s.italic??!1).map(i=>i.italic?`<tspan font-style="italic">${J(i.text)}</tspan>`:J(i.text)).join(""),r=`paint-order="stroke" ${S("stroke",this.inkOf(s.halo))} stroke-width="${se}"`,l=`x="${w(t)}" y="${w(n)}" font-size="${s.size}" text-anchor="${a}"`;this.#e.push(`<text ${l} ${S("fill",this.inkOf(s.ink))} ${r}>${o}</text>`)}picture(e,t,n,s,a){let o=document.createElement("canvas");[o.width,o.height]=[e.width,e.height],o.getContext("2d").drawImage(e,0,0);let r=`x="${w(t)}" y="${w(n)}" width="${w(s)}" height="${w(a)}"`;this.#e.push(`<image ${r} preserveAspectRatio="none" href="${o.toDataURL("image/png")}"/>`)}#n(e,t=this.colours[e.stroke??"ink"]){let n=e.dash===void 0?"":` stroke-dasharray="${e.dash.join(" ")}"`,s=w((e.width??1)*this.weight);return`${S("stroke",t,e.strokeOpacity)} stroke-width="${s}"${n}`}#s(e,t){this.#e.push(`<g ${e}>`),t(),this.#e.push("</g>")}fillDisc({x:e,y:t,r:n},s){let a=typeof s=="string"?S("fill",s):`fill="url(#${this.#o(s)})"`;this.#e.push(`<circle ${a} cx="${w(e)}" cy="${w(t)}" r="${w(n)}"/>`)}#o({id:e,stops:t}){let n=t.map(([a,o])=>`<stop offset="${a}" ${S("stop-color",o,1,"stop-opacity")}/>`),s=Object.entries(le).map(([a,o])=>`${a}="${w((o+(a==="r"?0:1))/2)}"`);return this.#a(e,`<radialGradient id="${e}" ${s.join(" ")}>${n.join("")}</radialGradient>`)}#r(e){let[t,n]=[`hatch-${e}`,ae],s=`M0 ${n/2}H${n}${e==="crossed"?`M${n/2} 0V${n}`:""}`,a=`${S("stroke",this.colours.hatch)} stroke-width="${oe}"`,o=`width="${n}" height="${n}" patternUnits="userSpaceOnUse" patternTransform="rotate(-45)"`;return this.#a(t,`<pattern id="${t}" ${o}><path ${a} d="${s}"/></pattern>`)}#a(e,t){return this.#t.includes(t)||this.#t.push(t),e}};function ge(e){let t="";return e({moveTo:(n,s)=>t+=`M${w(n)} ${w(s)}`,lineTo:(n,s)=>t+=`L${w(n)} ${w(s)}`,ellipse(n,s,a,o,r,l,i,c=!1){let[d,h]=[Math.cos(r),Math.sin(r)],p=f=>{let[m,b]=[a*Math.cos(f),o*Math.sin(f)];return[n+m*d-b*h,s+m*h+b*d]};t===""?this.moveTo(...p(l)):this.lineTo(...p(l));let g=Math.ceil(Math.abs(i-l)/Ye),u=`${w(a)} ${w(o)} ${w(r*180/Math.PI)} 0 ${c?0:1}`;for(let f=1;f<=g;++f){let[m,b]=p(l+(i-l)*f/g);t+=`A${u} ${w(m)} ${w(b)}`}},closePath:()=>t+="Z"}),t}function w(e){return z(e,Je)}function S(e,t,n=1,s=`${e}-opacity`){let[a,o,r,l=1]=(t.match(/[\d.]+/g)??[]).map(Number),i=l*n,c=i===1?"":` ${s}="${w(i)}"`;return`${e}="rgb(${a}, ${o}, ${r})"${c}`}function J(e){return e.replace(/&/g,"&amp;").replace(/</g,"&lt;").replace(/>/g,"&gt;")}var _={lon:["longitude","lon","lng","long","longitud","longitudine","längengrad","laengengrad","долгота","经度","經度","経度","خط الطول"],lat:["latitude","lat","latitud","latitudine","breitengrad","широта","纬度","緯度","خط العرض"],unsure_lon:["x","xcoord","länge","laenge","الطول"],unsure_lat:["y","ycoord","breite","العرض"],beside:["coord","coords","coordinate","coordinates","point","geo","geogr","geographische","deg","degrees","grad"],missing:["","na","n/a","#n/a","nan","null","none","<na>","-","–"],compass:{E:"East Ost Osten Est Este Leste в.д. 东经 東経 شرقا",W:"West Westen Ouest Oeste Ovest з.д. 西经 西経 غربا",N:"North Nord Norden Norte с.ш. 北纬 北緯 شمالا",S:"South Süd Süden Sud Sur Sul ю.ш. 南纬 南緯 جنوبا"},lettered:"n\\W?s|e\\W?w|[nsew]|\\w*hem\\w*|\\w*(?:lat|lon)\\w*(?:ns|ew|[nsew]|dir|ref)|column_\\d+",zeros:"٠۰０",printed:"−–   　٫．，،",typed:"--    ..,,",unseen:"​‎‏\uFEFF",western:"°ºªà-öø-ÿÀ-ÖØ-ß€‘’“”–—«»²³µ ŒœŠšŽžŸ"},O=/^[-+]?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:e[-+]?[0-9]+)?$/i,Ze=new Set(_.missing),N=e=>Ze.has(e.trim().toLowerCase()),Qe=new RegExp(`\\0|[^\\x00-\\x7f${_.western}]|[^\\x00-\\x7f]{3}`),et="぀";function Y(e,t=!1){let n=["lon","lat"].map(o=>{let[r,l]=[_[o],_[`unsure_${o}`]],i=u=>u.trim().toLowerCase(),c=(u,f)=>i(f).includes(u)&&(u>et||me(f).includes(u)),d=u=>me(u).filter(f=>!_.beside.includes(f)),g=[u=>r.includes(i(u)),u=>r.some(f=>c(f,u)),u=>l.includes(i(u))||d(u).length>0&&d(u).every(f=>l.includes(f))].slice(0,t?2:3).map(u=>e.filter(u)).find(u=>u.length>0);return g?.length===1?g[0]:null}),[s,a]=n;return s===null||a===null||s===a?null:[s,a]}function me(e){return e.replace(/(?<=[a-z])(?=[A-Z])/g," ").toLowerCase().split(/[^\p{L}]+/u).filter(Boolean)}var tt=new RegExp(`^(?:${_.lettered})$`,"iu"),nt=new RegExp(`[${_.printed}${_.unseen}]|\\p{Nd}`,"gu");function K(e){let t=n=>{let s=[..._.zeros].find(o=>n>=o&&n.charCodeAt(0)-o.charCodeAt(0)<10);if(s!==void 0)return String(n.charCodeAt(0)-s.charCodeAt(0));let a=_.printed.indexOf(n);return a<0?_.unseen.includes(n)?"":n:_.typed[a]};return e.replace(nt,t).trim().replace(/\s+/g," ")}var st=new Map(Object.entries({..._.compass,O:"O"}).flatMap(([e,t])=>[e,...t.toLowerCase().split(" ")].map(n=>[n,e]))),Re=e=>st.get(e.length>1?e.toLowerCase():e),be="[0-9]+(?:[.,][0-9]*)?",at=new RegExp(`^(?<before>[\\p{L}.]+)?\\s*(?<sign>[-+])?\\s*(?<degrees>[0-9]{1,3}(?:[.,][0-9]*)?)(?:\\s*(?:deg(?:rees?)?|[°º˚d:度]|\\s)\\s*(?:(?<minutes>${be})(?:\\s*(?:min|['′’‘´m:分]|\\s)\\s*(?:(?<seconds>${be})\\s*(?:''|’’|′′|["″”“秒]|sec|s)?)?)?)?)?\\s*(?<after>[\\p{L}.]+)?$`,"u");function ot(e){let t=e.length>200?null:at.exec(K(e))?.groups;if(!t)return null;let{before:n,after:s,sign:a}=t,o=[t.degrees,t.minutes,t.seconds].filter(h=>h!==void 0),r=n??s?Re(n??s):"",l=o.slice(0,-1).every(h=>/^[0-9]+$/.test(h)),i=o.map(h=>h.replace(",",".").replace(/\.$/,""));return r===void 0||n&&s||r&&a||!l||i.slice(1).some(h=>Number(h)>=60)?null:{degrees:(r==="W"||r==="S"||a==="-"?-1:1)*(r==="O"?NaN:rt(i)),point:r}}function rt(e){if(e.length===1)return Number(e[0]);let t=e[e.length-1].split(".")[1]?.length??0,[n,s,a=0n]=e.map((c,d)=>{let h=d===e.length-1;return BigInt(c.replace(".",""))*(h?1n:10n**BigInt(t))}),[o,r]=[(n*60n+s)*60n+a,3600n*10n**BigInt(t)],l=128+r.toString(2).length,i=o<<BigInt(l);return Number(i/r|(i%r===0n?0n:1n))/2**l}var Pe=/^[-+]?[1-9][0-9]{0,2}[.,][0-9]{3}$/,it=/^[-+]?0[0-9]/;function lt(e){let[t,n]=["x","y"].map(s=>e.filter(a=>a.trim().toLowerCase()===s));return t.length===1&&n.length===1?[t[0],n[0]]:e.length===2?[e[0],e[1]]:null}function ct(e,t,n){let[s,a]=[we(e,t,"longitude"),we(e,n,"latitude")];return Le(Ne(s,a),e.wrong)}function Le(e,t){for(let n=0;n<e.length/2;++n){let[s,a]=[e[2*n],e[2*n+1]];t.has(n)||(Math.abs(a)>90?t.set(n,`latitude ${a} is outside [-90, 90]; is it the longitude, or not in degrees?`):Math.abs(s)>360&&t.set(n,`longitude ${s} is outside [-360, 360]`))}return e}function dt(e,t,n){let s=Te(e.columns),a=[t,n].map(o=>Ie(e,o,e.columns.get(o),r=>De(r,s)?"may have a decimal mark or thousands; write thousands without one":Me(r)));return Ne(a[0],a[1])}function ht(e,t){let n=Te(e),s=o=>O.test(o)&&!it.test(o)&&!De(o,n),a=new Map;for(let[o,r]of e){let l=i=>N(i)||s(i.trim());t.has(o)||!r.every(l)||r.every(N)||a.set(o,Float64Array.from(r,i=>N(i)?NaN:Oe(i.trim())))}return a}function Te(e){let t=new Set;for(let n of e.values())for(let s of n){if(!/[.,]/.test(s))continue;let a=s.trim();O.test(a)&&!Pe.test(a)&&t.add(Ae(a))}return[...t].join("")||"."}var Ae=e=>e.includes(",")?",":".",De=(e,t)=>Pe.test(e)&&Ae(e)!==t;function Ne(e,t){return Float64Array.from({length:2*e.length},(n,s)=>(s%2===0?e:t)[s>>1])}var Oe=e=>Number(e.replace(",","."));function we(e,t,n){return Ie(e,n,pt(e,t,n),s=>{let a=O.test(s)?null:ot(s);if(a===null)return Me(s);let o=a.point===""?n:/[NS]/.test(a.point)?"latitude":"longitude";return o!==n?`is a ${o}`:a.point==="O"?"has an O, which is east in German and west in French; write E or W in its place":a.degrees})}function pt({columns:e},t,n){let[s,a]=[e.get(t),[...e.keys()]],o=a[a.indexOf(t)+1]??"";if(!tt.test(o))return s;let[r,l]=[s,e.get(o)].map(d=>d.map(h=>N(K(h))?"":K(h))),i=l.filter(Boolean).map(d=>Re(d)??"?");return i.length>0&&i.every(d=>(n==="latitude"?"NS":"EWO").includes(d))&&!r.some(d=>d.includes("-"))?r.map((d,h)=>d&&`${d} ${l[h]}`.trim()):s}var Me=e=>O.test(e)?Oe(e):NaN;function Ie({wrong:e},t,n,s){return Float64Array.from(n,(a,o)=>{let r=a.trim(),l=s(r);if(typeof l=="number"&&Number.isFinite(l))return l;let i=typeof l=="string"?l:"is not a number";return e.has(o)||e.set(o,`the ${t} ${N(r)?"is missing":`'${r}' ${i}`}`),NaN})}var ut=[",",";","	","|"],ft=50,gt=20,G=/\r\n|\n|\r/,mt=/^(?:[ \t]*#[^\r\n]*(?:\r\n?|\n|$))+/;function bt(e){let t=mt.exec(e)?.[0]??"",n=e.slice(t.length),s=wt(n),a=t.split(G).length,r=[...s===null?yt(n,a):$t(n,s,a)].filter(({cells:m})=>m.some(b=>b.trim()!==""));if(r.length===0)throw new v("the table is empty: there is not even a line with the names of the columns");let{names:l,data:i}=_t(r),c=i.length<r.length,d=l.find((m,b)=>m!==""&&l.indexOf(m)!==b);if(d!==void 0)throw new v(`there are several columns with the name '${d}'`);let h=l.map(()=>[]),p=new Map,g=l.reduce((m,b,y)=>b===""?m:y+1,0);i.forEach(({cells:m},b)=>{let y=m.length>=g&&m.slice(l.length).every(L=>L===""),[M,D]=[`${m.length} field${m.length===1?"":"s"}`,`${l.length} columns`];y||p.set(b,`has ${M}, but there are ${D}`),h.forEach((L,T)=>L.push(m[T]??""))});let f=l.map((m,b)=>[m||`column_${b+1}`,h[b]]).filter(([,m],b)=>l[b]!==""||m.some(y=>y!==""));return{columns:new Map(f),count:i.length,isHeaded:c,lines:i.map(({line:m})=>m),wrong:p}}function wt(e){let t=e.split(G,ft).filter(i=>i.trim()!==""),n=t.map(i=>i.replace(/"[^"]*"/g,"")),a=ut.map(i=>({mark:i,widths:n.map(c=>c.split(i).length)})).filter(({widths:i})=>Math.max(0,...i)>1),o=a.filter(({widths:i})=>new Set(i).size===1),r=[...new Set(t.map(i=>i.trim().split(/\s+/).length))];if(a.length===0||o.length===0&&r.length===1&&r[0]>1)return null;let l=({widths:i})=>Math.max(...i.map(c=>c>1?1e6*i.filter(d=>d===c).length+c:0));return(o.length>0?o:a).reduce((i,c)=>l(c)>l(i)?c:i).mark}function*yt(e,t){for(let[n,s]of e.split(G).entries())yield{cells:s.trim().split(/\s+/),line:t+n}}function*$t(e,t,n){let s=`[^"\\${t}\\r\\n][^\\${t}\\r\\n]*`,a=new RegExp(`(?:"([^"]*(?:""[^"]*)*)"|(${s})?)(\\${t}|\\r\\n|\\n|\\r|$)`,"y"),[o,r,l]=[[],n,n];for(;a.lastIndex<e.length;){let i=a.exec(e);if(i===null){let c="a field begins with a quotation mark but does not end with one";throw new v(`line ${r}: ${c}; inside such a field write it twice`)}i[1]!==void 0&&(l+=i[1].split(G).length-1),o.push(i[1]?.replaceAll('""','"')??i[2]??""),i[3]!==t&&(yield{cells:o,line:r},[o,r]=[[],++l])}o.length>0&&(yield{cells:[...o,""],line:r})}function _t(e){let t=e.slice(0,gt).map(({cells:c})=>c.map(d=>d.trim())),n=t.map(c=>c.filter(d=>d!=="")),s=c=>O.test(c),a=n.findIndex((c,d)=>Y(c)!==null&&(d===0||!c.some(s))),o=n.findIndex(c=>c.length>1),r=Math.max(0,a>=0?a:o);return a<0&&2*n[r].filter(s).length>n[r].length?{names:t[r].length===2?["lon","lat"]:t[r].map((c,d)=>`column_${d+1}`),data:e.slice(r)}:{names:t[r],data:e.slice(r+1)}}function vt(e,{places:t,names:n=null,values:s=new Map}){let a=i=>Object.is(i,-0)?"-0.0":Number.isFinite(i)?`${i}`:"",o=i=>/[",\r\n]/.test(i)?`"${i.replaceAll('"','""')}"`:i,r=[...e,...n===null?[]:["name"],...[...s.keys()].map(o)],l=Array.from({length:t.length/2},(i,c)=>{let d=n===null?[]:[o(n[c])],h=[...s.values()].map(p=>a(p[c]));return[a(t[2*c]),a(t[2*c+1]),...d,...h].join(",")});return`${[r.join(","),...l].join(`
`)}
`}var v=class extends Error{},Ce=class extends v{names;constructor(e){super("the table has no two columns of coordinates"),this.names=e}};function St(e){let t=Et(e),n=E(t,"type")==="Feature"?[t]:E(t,"features");if(!Array.isArray(n))throw new v("the file is not a GeoJSON FeatureCollection of points");Rt(t);let s=new Map,a=n.map((c,d)=>{let h=kt(c);return typeof h=="string"&&s.set(d,h),typeof h=="string"?[NaN,NaN]:h}),o=Le(Float64Array.from(a.flat()),s),r=n.map(c=>E(c,"properties")),l=new Set(r.flatMap(c=>Object.keys(c??{}))),i=new Map([...l].map(c=>[c,r.map(d=>xt(E(d,c)))]));return{places:o,table:{columns:i,count:n.length,isHeaded:!0,lines:[],wrong:s}}}function xt(e){return typeof e=="object"?JSON.stringify(e??void 0)??"":String(e??"")}function E(e,t){return typeof e=="object"&&e!==null?e[t]:void 0}function Et(e){try{return JSON.parse(e)}catch(t){let n=e.split(`
`).map(s=>s.replace(/^[\x1e \t\r]+|[\x1e \t\r]+$/g,""));try{if(!n[0].endsWith("}"))throw t;return{features:n.filter(s=>s!=="").map(s=>JSON.parse(s))}}catch{throw new v(`the file is not JSON: ${t instanceof Error?t.message:String(t)}`)}}}function kt(e){let t=E(e,"geometry"),[n,s]=[E(t,"type"),E(t,"coordinates")],a=n==="MultiPoint"&&Array.isArray(s)&&s.length===1;if(n!=="Point"&&!a)return`a Point is needed, not ${typeof n=="string"?n:"no geometry"}`;let o=a?s[0]:s,r=Array.isArray(o)?o.slice(0,2):[];return r.length===2&&r.every(Number.isFinite)?r:`a Point has two or three coordinates, not ${JSON.stringify(o)}`}function Rt(e){let t=E(e,"crs")??null;if(t===null)return;let n=String(E(E(t,"properties"),"name"));if(!/(CRS84|EPSG::4326|EPSG:4326)$/i.test(n))throw new v(`the file is in ${n}, the page reads degrees; to make a page of it, type: stereodel web FILE`)}var ye=1e6,Pt=/\.(jpe?g|png|webp|avif)$/i,Lt=/\.(csv|tsv|txt)(\.gz)?$/i,Tt=/\.(geojson|json|geojsonl|geojsons)(\.gz)?$/i;function ze(e){return e.type.startsWith("image/")||Pt.test(e.name)}async function At(e,t,n,s){let{text:a,guess:o}=Mt(await Ot(t),e),r=Tt.test(e)||!Lt.test(e)&&/^[\s\x1e]*\{/.test(a);if(r&&n==="plane")return{room:"globe"};let l=r?St(a):Nt(a,n,s);if("room"in l)return l;let{places:i,table:c,axes:d=[]}=l,{count:h,wrong:p}=c;if(h===0)throw new v("there are no points");if(h>ye){let b=`the page takes up to ${k(ye)}; for more there is the Python library`;throw new v(`there are ${k(h)} points; ${b}`)}let g=p.size===0?"":Dt(c);if(p.size===h)throw new v(g);let u=(b,y)=>!p.has(y),f=new Map([...c.columns].map(([b,y])=>[b,y.filter(u)])),m=[...f.keys()].find(b=>b.trim().toLowerCase()==="name")??"";return{file:e,places:i.filter((b,y)=>u(0,y>>1)),names:f.get(m)??null,values:ht(f,new Set([...d,m])),leftOut:p.size,wrong:g,guess:o}}function Dt({count:e,lines:t,wrong:n}){let s=[...n.keys()].reduce((l,i)=>Math.min(l,i)),a=n.size===e?"No row":`${k(n.size)} of ${k(e)} rows`,o=t.length===0?"":`, on line ${k(t[s])}`,r=n.size===e?"can":"cannot";return`${a} ${r} be placed. Row ${k(s+1)}${o}: ${n.get(s)}`}function Nt(e,t,n){let s=bt(e),a=[...s.columns.keys()],o=s.isHeaded?Y(a,!0):null,r=n??(t==="lonlat"?Y(a):lt(a));if(r===null&&o!==null)return{room:"globe"};if(r===null)throw new Ce(a);let l=(t==="lonlat"?ct:dt)(s,...r),i=[...s.wrong.keys()].filter(c=>Number.isFinite(l[2*c]+l[2*c+1]));return t==="lonlat"&&o===null&&2*i.length>s.count?{room:"lift",columns:r}:{places:l,table:s,axes:r}}async function Ot(e){if(!(e[0]===31&&e[1]===139))return e;try{let t=new Blob([e.slice()]).stream().pipeThrough(new DecompressionStream("gzip"));return new Uint8Array(await new Response(t).arrayBuffer())}catch{throw new v("the compressed file is damaged")}}function Mt(e,t){let n=String.fromCharCode(...e.subarray(0,2)),s=/^(\xff\xfe|[^\0]\0)/.test(n)?"utf-16le":/^(\xfe\xff|\0)/.test(n)?"utf-16be":null,a=(c,d)=>{try{let h=new TextDecoder(c,{fatal:!0}).decode(e);return/^\s*</.test(h)||d.test(h)?null:h}catch{return null}},o=a(s??"utf-8",/\0/);if(o!==null)return{text:o,guess:null};let r=s===null?a("windows-1252",Qe):null;if(r!==null)return{text:r,guess:"windows-1252"};let l=/^[\w.-]+$/.test(t)?t:`"${t}"`,i="neither a picture nor a table in text that the page can read";throw new v(`${i}; to make a page of it, type: stereodel web ${l}`)}async function je(e,t,n,s,a){if(ze(e))return n.pass("globe",e);let{messages:o}=n,r=`${e.name}:`,l=f=>`${f}${/[.?!]$/.test(f)?"":"."} Nothing has changed.`,i;try{i=await At(e.name,new Uint8Array(await e.arrayBuffer()),t,a)}catch(f){let m=(...b)=>je(e,t,n,s,b);return f instanceof Ce&&f.names.length>1?It(e.name,f.names,t,o,m):o.show(r,l(f instanceof v?f.message:"the file cannot be read"))}if("room"in i)return n.pass(i.room,e,i.columns);let c=i,{leftOut:d,wrong:h,guess:p}=c,g=()=>{o.close(),s(c),p!==null&&o.show(r,`it does not say its encoding; read as ${p}.`)};if(d===0)return g();let u=d===1?"this row":`these ${k(d)} rows`;o.show(r,l(h),{words:`Open without ${u}`,act:g})}function It(e,t,n,s,a){let o=n==="lonlat"?["Longitude","Latitude"]:["x","y"],r=o.map((c,d)=>{let h=$("select","",...t.map(p=>$("option","",p)));return h.selectedIndex=Math.min(d,t.length-1),h}),l={words:"Open",act:()=>a(r[0].value,r[1].value)},i=o.map((c,d)=>$("label","field column",`${c} `,r[d]));s.show(`Which columns of ${e}?`,"",l,i)}var Ct=7;function zt(e,t="spherical"){return`{"type":"FeatureCollection","features":[
${e.map(({properties:s,corners:a})=>{let o=a.length===0?jt:Ht(a,t);return JSON.stringify({type:"Feature",properties:s,geometry:o})}).join(`,
`)}
]}
`}var jt={type:"Polygon",coordinates:[[...j(-180,-90,180,90),[-180,-90]]]};function Ht(e,t){let n=Ut(e.flatMap((r,l)=>pe(r,e[(l+1)%e.length])),t),s=Math.round((n[n.length-1][0]-n[0][0])/360),a=s===0?n:Ft(n,s),o=Wt(a).map(r=>[r.map(([l,i])=>[$e(l),$e(i)])]);return o.length===1?{type:"Polygon",coordinates:o[0]}:{type:"MultiPolygon",coordinates:o}}function $e(e){return Number(e.toFixed(Ct))}function Ut(e,t){let n=ue(Float64Array.from([...e,e[0]].flatMap(A)),t),s=[];for(let a=0;a<n.length;a+=2){let o=s[s.length-1]?.[0]??n[a];s.push([n[a]+360*Math.round((o-n[a])/360),n[a+1]])}return s}function Ft(e,t){let n=t>0?90:-90,s=t>0?[...e]:[...e].reverse(),a=360*Math.ceil((s[0][0]-180)/360)+180,o=s.findIndex(([h])=>h>=a),r=He(s[Math.max(0,o-1)],s[o===-1?s.length-1:o],a),l=s.slice(Math.max(o,0),-1).map(([h,p])=>[h-a-180,p]),i=s.slice(0,Math.max(o,0)).map(([h,p])=>[h-a+180,p]),c=[[-180,r],...l,...i,[180,r]],d=t>0?c:c.reverse();return[...d,[d[d.length-1][0],n],[d[0][0],n],d[0]]}function He(e,t,n){return e[0]===t[0]?e[1]:e[1]+(n-e[0])/(t[0]-e[0])*(t[1]-e[1])}function Wt(e){let t=e.map(([o])=>o),n=Math.floor((Math.min(...t)+180)/360),s=Math.ceil((Math.max(...t)+180)/360),a=[];for(let o=n;o<Math.max(s,n+1);++o){let r=e.slice(0,-1).map(([i,c])=>[i-360*o,c]),l=_e(_e(r,-180,1),180,-1);l.length>2&&a.push([...l,l[0]])}return a}function _e(e,t,n){let s=[];return e.forEach((a,o)=>{let r=e[(o+1)%e.length],[l,i]=[n*(a[0]-t)>=0,n*(r[0]-t)>=0];l&&s.push(a),l!==i&&a[0]!==t&&r[0]!==t&&s.push([t,He(a,r,t)])}),s}var ve=Float64Array.of(-Math.PI,-Math.PI/2,Math.PI,Math.PI/2),Se=2**15,Gt=class{width;height;texels;levels;constructor(e,t){if(this.width=H(t,"width",2,2**20),this.height=t/2,e.length!==4*this.width*this.height){let a=`four for each of ${t} × ${this.height} pixels: a picture of the whole globe`;throw new RangeError(`pixels has ${e.length} numbers, and not ${a} is twice as wide as high`)}this.texels=new q(Bt(e));let n=fe().run(a=>a.call("raster_levels_size",this.width,this.height)),s=[this.texels,this.width,this.height,ve];this.levels=new q(X(Uint8Array,n,"raster_levels",...s))}warp(e,t){return this.painted(e,[-1,1,2/t,2/t],t,t)}painted(e,t,n,s,a=!0){H(n,"width",1,Se),H(s,"height",1,Se);let o=e.inverse(),r=Float64Array.of(...o.right.matrix,o.magnification,...o.left.matrix,0),i=[...[this.texels,this.levels,this.width,this.height,ve],r,Float64Array.of(...t),n,s,a?1:0];return X(Uint8ClampedArray,4*n*s,"warp_raster",...i)}};function Bt(e){let t=Uint8Array.from(e);for(let n=0;n<t.length;++n)n%4!==3&&(t[n]=Math.floor((t[n]*t[n|3]+127)/255));return t}var Vt=4096,qt=2,Xt=.25,[Jt,Yt]=[.6,120],Kt=.01;async function Zt(e,t,n){let s=await createImageBitmap(e).catch(()=>null);if(s===null||Math.abs(s.width/s.height-2)>Kt){let l=s&&`is ${s.width} × ${s.height}; one of the whole sphere is twice as wide as high`;t.show(`${e.name}:`,`the picture ${l??"cannot be read"}. Nothing has changed.`);return}let a=Math.round(Math.min(s.width,Vt)/2),o=$("canvas",{width:2*a,height:a}),r=o.getContext("2d",{willReadFrequently:!0});r.drawImage(s,0,0,o.width,o.height),s.close(),t.close(),n(new Qt(e.name,r.getImageData(0,0,o.width,o.height)))}var Qt=class{name;#t;#e;letters;constructor(e,t){this.name=e,this.#t=new Gt(t.data,t.width),this.#e=nn(t);let n=[0,0,0];for(let i=0;i<t.data.length;++i)i%4<3&&(n[i%4]+=t.data[i]);let s=n.map(i=>4*i/t.data.length),a=.3*s[0]+.59*s[1]+.11*s[2]>Yt,o=s.map(i=>Math.round(i+Jt*((a?255:0)-i))),[r,l]=a?["27, 27, 27","171, 67, 0"]:["255, 255, 255","245, 160, 98"];this.letters={ink:`rgb(${r})`,accent:`rgb(${l})`,halo:`rgb(${o.join(", ")})`}}draw(e,t,n,s){let a=s&&this.#e===null?Xt:Math.min(qt,devicePixelRatio),o=Math.max(1,Math.ceil(2*t.r*a)),r=s&&this.#e!==null?this.#e(n,o):this.#n(n,o);e.clipped(l=>l.ellipse(t.x,t.y,t.r,t.r,0,0,2*Math.PI),()=>e.picture(r,t.x-t.r,t.y-t.r,2*t.r,2*t.r))}#n(e,t){let n=$("canvas",{width:t,height:t}),s=new ImageData(this.#t.painted(e,[-1,1,2/t,2/t],t,t,!1),t,t);return n.getContext("2d").putImageData(s,0,0),n}},en=`#version 300 es
out vec2 place;
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
  gl_Position = vec4(place, 0.0, 1.0);
}`,tn=`#version 300 es
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
}`;function nn(e){let t=$("canvas"),n=t.getContext("webgl2",{antialias:!1,depth:!1,alpha:!0});if(n===null||n.getParameter(n.MAX_TEXTURE_SIZE)<e.width)return null;let s=n.createProgram();for(let[a,o]of[[n.VERTEX_SHADER,en],[n.FRAGMENT_SHADER,tn]]){let r=n.createShader(a);n.shaderSource(r,o),n.compileShader(r),n.attachShader(s,r)}return n.linkProgram(s),n.getProgramParameter(s,n.LINK_STATUS)?(n.useProgram(s),n.bindTexture(n.TEXTURE_2D,n.createTexture()),n.texImage2D(n.TEXTURE_2D,0,n.RGBA,n.RGBA,n.UNSIGNED_BYTE,e),n.generateMipmap(n.TEXTURE_2D),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_MIN_FILTER,n.LINEAR_MIPMAP_LINEAR),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_S,n.REPEAT),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_T,n.CLAMP_TO_EDGE),({left:a,right:o,magnification:r},l)=>{t.width!==l&&(t.width=t.height=l),n.viewport(0,0,l,l);for(let[i,{matrix:c}]of Object.entries({left:a,right:o}))n.uniformMatrix3fv(n.getUniformLocation(s,i),!0,new Float32Array(c));return n.uniform1f(n.getUniformLocation(s,"magnification"),1/r),n.drawArrays(n.TRIANGLES,0,3),t}):null}var P={ink:"ink",halo:"paper",size:14},xe={...P,size:24,align:"center"},Ee={...P,ink:"ink-2",size:13,align:"center"},U=286,W=270,R=20,F=11;function Ue(e,t){let n=e.map(r=>r.bar?sn(r):r.circles?an(r):on(r)),s=Math.max(1,Math.min(n.length,Math.floor(t/U))),a=[],o=new Array(s).fill(0);for(let r of n){let l=o.indexOf(Math.min(...o));a.push({block:r,x:Math.max(0,(t-s*U+U-W)/2)+l*U,y:o[l]}),o[l]+=r.height}return{height:Math.max(...o),draw:(r,l,i)=>a.forEach(c=>c.block.draw(r,l+c.x,i+c.y))}}function sn({title:e,bar:t=[],ticks:n=[],missing:s}){return{height:(s?4.2:3.2)*R,draw(a,o,r){a.label(e,o,r+.7*R,P);let[l,i]=[r+R,r+R+F],c=(d,h,p,g)=>a.draw("swatch",u=>he(u,j(d,p,h,p+F)),g);t.forEach((d,h)=>c(o+W*h/t.length,o+W,l,d));for(let[d,h]of n){let p=o+W*d;a.draw("tick",u=>V(u,[p,i],[p,i+4]));let g=d<.04?"left":d>.96?"right":"center";a.label(h,p,i+18,{...P,align:g})}s&&(c(o,o+2*F,i+27,s[1]),a.label(s[0],o+2*F+8,i+37,P))}}}function an({title:e,circles:t=[],ink:n}){let s=Math.max(...t.map(([o])=>o)),a=1.3*R+2*s;return{height:a+R,draw(o,r,l){o.label(e,r,l+.7*R,P);let i=l+a,c=-1/0;for(let[d,h]of t){o.spots([r+s,i-d,d],[n??"transparent"]);let p=i-2*d;c=Math.max(p,c+15);let g=[[r+s,p],[r+2*s,p],[r+2*s+12,c]];o.draw("tick",u=>{V(u,g[0],g[1]),u.lineTo(...g[2])}),o.label(h,g[2][0]+4,c+4.5,P)}}}}function on({title:e,ink:t}){return{height:R,draw(n,s,a){n.spots([s+6,a+10,5],[t??"transparent"]),n.label(e,s+20,a+14.5,P)}}}function rn(e){return e.map(({title:t,ticks:n,circles:s})=>[t,...(n??s??[]).map(([,a])=>a)].join(" ")).join("; ")}function Fe(e){let{width:t,paint:n,owner:s}=e;if(!s)return e;let a=ke(s.title,1.9*t/xe.size),o=a.length*30+(a.length>0?6:0),r=s.legend?.length?Ue(s.legend,t):null,l=o+e.height+8,i=ke(s.source,2.1*t/Ee.size),c=l+(r?.height??0);return{...e,title:s.title?`${s.title}. ${e.title}`:e.title,height:c+(i.length>0?i.length*17+10:0),paint(d){a.forEach((h,p)=>d.label(h,t/2,26+30*p,xe)),d.lowered(o,()=>n(d)),r?.draw(d,0,l),i.forEach((h,p)=>d.label(h,t/2,c+14+17*p,Ee))}}}function ke(e,t){let n=[];for(let s of e.split(/\s+/).filter(Boolean)){let a=n[n.length-1];a!==void 0&&a.length+s.length<t?n[n.length-1]=`${a} ${s}`:n.push(s)}return n}var ln=`from dataclasses import replace

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
`,cn=`import numpy as np

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
`,dn=`import numpy as np

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
[step] for corners in opened[np.linalg.det(points[opened]) > 0].tolist():  # others close the hull
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
`,We=200,Ge="cities().lonlat[cities().population >= 2_000_000]",hn=`SphericalDelaunay.from_lonlat(airports().lonlat).nearest(lonlat=${Ge})`,pn={cities:Ge,airports:`airports().lonlat[np.unique(${hn})]`,stars:"stars().lonlat[stars().magnitude <= 3.0]"};function un(e,t,n,s,a){let{sites:o,view:r,bubble:l,aim:i,step:c}=e,d=u=>c==="done"&&e.isOn(u),h=[...d("bubble")&&l?.sites||[],...c==="done"?e.held:[c.site]],p={facets:o.facetCount>0,hemisphere:o.hasClosing,step:c!=="done"&&c.insertion!==null,aimed:l!==null,held:h.length>0,pole:n!==null,front:n!==null&&n[2]>=0,hatched:d("seeing")||d("closing")&&o.hasClosing},g={...a,sites:pn[s.set]??Q(o.lonlat,`${Be(s.file)}.lonlat`),pole:x(t.pole),view:x(r.middle),aim:A(i).join(", "),lens:`(${x(A(t.lens.focus))}), magnification=${t.lens.magnification}`,held:h.join(", "),step:c==="done"?"":c.site+1};return Z(dn,g,p,d)}function fn(e,t,n,s){let{sites:a,sheet:o,view:r,isOn:l}=e,[i,c]=[e.p,e.q].filter(f=>f!==null),{contact:d,height:h}=t,p=a.count===0?[3,2]:s,g={facets:a.delaunay.dimension===2,flat:o.isFlat,area:a.rectangle.width>0&&a.rectangle.height>0,letters:i!==void 0,pair:c!==void 0&&i!==c,pole:t.seenPole(h)!==null},u={points:Q(a.places,`np.loadtxt(${JSON.stringify(n.file)}, delimiter=",", skiprows=1, usecols=(0, 1))`),corners:p?`np.array([[-1, -1], [1, 1]]) * [${x(p)}] / 2`:"points.min(axis=0), points.max(axis=0)",view:x(r.middle),width:t.width,height:h,scale:t.scale,contact:`${d[0]}, ${h-d[1]}`,corner:o.corner,pair:[i,c].join(", "),shown:JSON.stringify(t.grounds)};return Z(cn,u,g,l)}function gn(e,t,n,s,a){let{lens:o,sight:r,from:l,to:i,before:c,after:d,pointer:h}=e,{places:p,latitude:g,picture:u,resolution:f}=t,m=o==="bubble",{owner:b,names:y,lonlat:M=new Float64Array(0)}=p??{},D=Be(p?.name??""),L=p===null||g==="spherical"?"":`, latitude="${g}"`,T=B=>{let I=`(${x(A(B))})`;return L===""?I:`lonlat_to_xyz(${I}${L})`},ee=({middle:B,roll:I})=>x([...B,I]).replace(/, -?0$/,""),Ve={focus:T(r.lens.focus),magnification:x([r.lens.magnification]),taken:`${T(l.center)}, ${x([l.radius])}`,filled:`${T(i.center)}, ${x([i.radius])}`,title:"",...b?.lines,file:D,places:Q(M,`${D}.lonlat`),words:M.length>2*We?`${D}.column("name")`:JSON.stringify(y),latitude:L,picture:JSON.stringify(u?.name??""),resolution:f,pointer:T(h),before:ee(c),view:ee(m?d:r.view),width:x([1.03*s*(m?2:1)])},{points:qe,scale:Xe}=b?.lines??{};return Z(ln,Ve,{bubble:m,picture:u,places:p,pointed:a,owned:qe,scaled:Xe,named:y},n)}function Z(e,t,n,s){let a=c=>c in n?!!n[c]:s(c),r=e.split(`
`).flatMap(c=>{let[,d,h]=/^(?:\[([!a-z ]+)\] )?(.*)$/.exec(c);return d?.split(" ").every(g=>g.startsWith("!")?!a(g.slice(1)):a(g))===!1?[]:[h]}).join(`
`).replace(/\{(\w+)\}/g,(c,d)=>String(t[d]??c)),l=r.replace(/^(from|import) .*\n/gm,""),i=c=>new RegExp(`\\b${c.split(" as ").pop()}\\b`).test(l);return r.replace(/^((?:from \S+ )?import )(.*)\n/gm,(c,d,h)=>{let p=h.split(", ").filter(i);return p.length===0?"":`${d}${p.join(", ")}
`})}function Q(e,t){if(e.length>2*We)return t;let n=Array.from({length:e.length/2},(a,o)=>`[${e[2*o]}, ${e[2*o+1]}]`),s=n.join(", ").replace(/(.{1,82}\],) /g,`$1
    `);return n.length===0?"np.zeros((0, 2))":`np.array([
    ${s},
])`}var Be=e=>`read_points(${JSON.stringify(e)})`;function x(e){return e.map(t=>z(t,7)).join(", ")}async function mn(e,t){let n=e.cloneNode(!0);n.querySelector("#block-state")?.remove();let s=$("script",{type:"text/plain",id:"block-state"},await bn(t));return n.querySelector("#block-kernel").before(s,`
`),new Blob([`<!doctype html>
`,n.outerHTML,`
`],{type:"text/html"})}async function bn(e){let t=new Blob([e]).stream().pipeThrough(new CompressionStream("deflate")),n=await new Response(t).blob();return new Promise((s,a)=>{let o=new FileReader;o.onload=()=>s(String(o.result).replace(/^.*,/,"")),o.onerror=()=>a(o.error),o.readAsDataURL(n)})}function wn(e,t,n="text/plain"){let s=typeof t=="string"?new Blob([t],{type:`${n};charset=utf-8`}):t,a=$("a",{href:URL.createObjectURL(s),download:e});a.click(),setTimeout(()=>URL.revokeObjectURL(a.href),6e4)}function yn(e){let{title:t,width:n,height:s,weight:a,paint:o}=Fe(e),r=new Ke(n,s,C(),a);return o(r),r.text(t)}function $n(e,t){let{width:n,height:s,weight:a,paint:o}=Fe(e),r=$("canvas",{width:Math.round(n*t),height:Math.round(s*t)}),l=r.getContext("2d");return l.fillStyle=C().paper,l.fillRect(0,0,r.width,r.height),o(new te(l,n,s,t,C(),a)),new Promise((i,c)=>{r.toBlob(d=>d===null?c(new Error("the picture is too large")):i(d))})}var _n={csv:vt,download:wn,geojson:zt,globePython:gn,isPicture:ze,legendBlock:Ue,legendWords:rn,liftPython:fn,openPanorama:Zt,openPoints:je,savedPage:mn,sheetPng:$n,sheetSvg:yn,spherePython:un};Object.assign(document.currentScript,{offers:_n});})();
